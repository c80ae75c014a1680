// From pixels to the floor: places, covariances by the formula and by chance, heads, and what lies above the horizon.
#include "fusion/vision/camera_model.h"
#include "tests/unit/fusion/jacobian.h"
#include "tests/unit/fusion/vision/cameras.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace locus::vision {
namespace {

using vision_test::looking_down;

const Eigen::Matrix2d one_pixel = Eigen::Matrix2d::Identity();

TEST(CameraModel, FootComesBackToWhereItStands) {
    for (const Lens& lens : vision_test::lenses()) {
        const FloorView view = looking_down(lens);
        for (const auto& floor_m : std::vector<Eigen::Vector2d>{{0, 8}, {1.5, 6}, {-2, 12}}) {
            const auto pixel = pixel_of_floor(view, floor_m);
            ASSERT_TRUE(pixel) << lens.index();
            const auto foot = foot_on_floor(view, {*pixel, one_pixel});
            ASSERT_TRUE(foot) << lens.index();
            EXPECT_LT((foot->position_site_m - floor_m).norm(), 1e-7) << lens.index();
        }
    }
}

TEST(CameraModel, StraightDownIsHeightOverFocalLength) {
    const FloorView view = looking_down(vision_test::plain_pinhole(), 4, std::acos(0.0));
    const auto foot = foot_on_floor(view, {{640 + 200, 360}, 4 * one_pixel});
    ASSERT_TRUE(foot);
    EXPECT_NEAR(foot->position_site_m.x(), 1, 1e-9); // 4 m x 200 / 800
    EXPECT_NEAR(foot->position_site_m.y(), 0, 1e-9);
    EXPECT_TRUE(foot->covariance_m2.isApprox(1e-4 * one_pixel, 1e-9)) << foot->covariance_m2; // (2 px x 4 m / 800)^2
}

TEST(CameraModel, CovarianceIsThatOfTheJacobian) {
    const Eigen::Matrix2d pixels = (Eigen::Matrix2d() << 4, 1, 1, 9).finished();
    for (const Lens& lens : vision_test::lenses()) {
        const FloorView view = looking_down(lens);
        const auto floor = [&](const Eigen::VectorXd& p) -> Eigen::VectorXd {
            return foot_on_floor(view, {p, one_pixel})->position_site_m;
        };
        const Eigen::Vector2d pixel = *pixel_of_floor(view, {1, 7});
        const Eigen::Matrix2d by_pixel = test::numerical_jacobian(floor, pixel, 1e-3);
        const Eigen::Matrix2d wanted_m2 = by_pixel * pixels * by_pixel.transpose();
        const auto foot = foot_on_floor(view, {pixel, pixels});
        ASSERT_TRUE(foot);
        EXPECT_TRUE(foot->covariance_m2.isApprox(wanted_m2, 1e-4)) << foot->covariance_m2 << "\n\n" << wanted_m2;
    }
}

TEST(CameraModel, CovarianceGrowsWithDistance) {
    const FloorView view = looking_down(vision_test::plain_pinhole());
    double last_m2 = 0;
    for (int i = 4; i < 60; i += 4) {
        const auto foot = foot_on_floor(view, {*pixel_of_floor(view, {0, 1.0 * i}), one_pixel});
        ASSERT_TRUE(foot);
        EXPECT_GT(foot->covariance_m2(1, 1), last_m2);
        EXPECT_GT(foot->covariance_m2(1, 1), foot->covariance_m2(0, 0)) << "along the line of sight is worst";
        last_m2 = foot->covariance_m2(1, 1);
    }
}

TEST(CameraModel, AboveTheHorizonIsRefused) {
    // 0.5 rad down: the horizon lies 800 tan(0.5) = 437 px above the centre.
    for (const double above_px : {437.1, 500.0, 5000.0})
        EXPECT_FALSE(foot_on_floor(looking_down(vision_test::plain_pinhole()), {{640, 360 - above_px}, one_pixel}));
    EXPECT_TRUE(foot_on_floor(looking_down(vision_test::plain_pinhole()), {{640, 360 - 436.9}, one_pixel}));
}

TEST(CameraModel, HeadOfKnownHeightTellsWhereTheFeetAre) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0, 1);
    const Camera camera = looking_down(vision_test::plain_pinhole());
    Eigen::Matrix2d scatter_m2 = Eigen::Matrix2d::Zero();
    FloorPoint last{};
    constexpr int people = 4000;
    for (int i = 0; i < people; ++i) { // 1.7 m tall more or less, seen with two pixels of error
        const Eigen::Vector2d error_px = 2 * Eigen::Vector2d(normal(random), normal(random));
        const auto sight = look_at(camera, {1, 9, 1.7 + 0.08 * normal(random)});
        ASSERT_TRUE(sight);
        const auto foot = foot_below_head(camera, {sight->pixel_px + error_px, 4 * one_pixel}, {1.7, 0.08});
        ASSERT_TRUE(foot);
        const Eigen::Vector2d error_m = foot->position_site_m - Eigen::Vector2d(1, 9);
        scatter_m2 += error_m * error_m.transpose() / people;
        last = *foot;
    }
    // 4,000 draws: the standard deviation of a variance is 2.2 % of it; the covariance also varies with the pixel.
    EXPECT_NEAR(scatter_m2(1, 1) / last.covariance_m2(1, 1), 1, 0.15);
    EXPECT_NEAR(scatter_m2(0, 0) / last.covariance_m2(0, 0), 1, 0.15);
    const auto feet = foot_on_floor(camera, {*pixel_of_floor(camera, {1, 9}), 4 * one_pixel});
    ASSERT_TRUE(feet);
    EXPECT_GT(last.covariance_m2(1, 1), feet->covariance_m2(1, 1)) << "hidden feet are known less well";
}

TEST(CameraModel, HeadAboveTheCameraIsRefused) {
    const Camera low = looking_down(vision_test::plain_pinhole(), 1.5, 0.1);
    EXPECT_FALSE(foot_below_head(low, {{640, 500}, one_pixel}, {1.7, 0.1}));
    EXPECT_FALSE(foot_below_head(FloorHomography{}, {{640, 500}, one_pixel}, {1.7, 0.1}));
}

/// The homography of a camera without distortion: floor to pixel is K [r1 r2 t].
FloorHomography homography_of(const Camera& camera, const PinholeLens& lens) {
    Eigen::Matrix3d intrinsic = Eigen::Matrix3d::Identity();
    intrinsic.diagonal().head<2>() = lens.focal_px;
    intrinsic.col(2).head<2>() = lens.centre_px;
    Eigen::Matrix3d pixel_from_floor;
    pixel_from_floor << camera.camera_from_site.leftCols<2>(), camera.site_in_camera_m;
    return floor_homography(-(intrinsic * pixel_from_floor).inverse(), {640, 719}); // either sign must do
}

TEST(CameraModel, HomographySaysWhatThePinholeSays) {
    const PinholeLens lens = vision_test::plain_pinhole();
    const Camera camera = looking_down(lens);
    const FloorView flat = homography_of(camera, lens);
    const Eigen::Vector2d half(0.5, 0.5);
    for (const auto& pixel : std::vector<Eigen::Vector2d>{{640, 360}, {100, 700}, {900, 50}}) {
        const auto by_lens = foot_on_floor(camera, {pixel, one_pixel});
        const auto by_plane = foot_on_floor(flat, {pixel, one_pixel});
        const auto small = foot_on_floor(scaled(flat, half), {0.5 * pixel, 0.25 * one_pixel});
        ASSERT_TRUE(by_lens && by_plane && small);
        EXPECT_LT((by_lens->position_site_m - by_plane->position_site_m).norm(), 1e-9);
        EXPECT_TRUE(by_lens->covariance_m2.isApprox(by_plane->covariance_m2, 1e-9));
        EXPECT_LT((small->position_site_m - by_plane->position_site_m).norm(), 1e-9);
        EXPECT_TRUE(small->covariance_m2.isApprox(by_plane->covariance_m2, 1e-9));
        const auto back = pixel_of_floor(flat, by_plane->position_site_m);
        ASSERT_TRUE(back);
        EXPECT_LT((*back - pixel).norm(), 1e-6);
    }
    EXPECT_FALSE(foot_on_floor(flat, {{640, 360 - 438}, one_pixel})) << "above the horizon";
}

} // namespace
} // namespace locus::vision
