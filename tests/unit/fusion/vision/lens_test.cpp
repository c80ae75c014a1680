// Lenses: there and back is the same ray, every derivative is that of the differences, and nothing folds back.
#include "fusion/vision/lens.h"
#include "tests/unit/fusion/jacobian.h"
#include "tests/unit/fusion/vision/cameras.h"

#include <gtest/gtest.h>

#include <random>

namespace locus::vision {
namespace {

Eigen::Vector3d random_ray(std::mt19937& random, double widest_slope) {
    std::uniform_real_distribution<double> slope(-widest_slope, widest_slope), depth(0.5, 30);
    return depth(random) * Eigen::Vector3d(slope(random), slope(random), 1);
}

TEST(Lens, ThereAndBackIsTheSameRay) {
    std::mt19937 random(1);
    for (const Lens& lens : vision_test::lenses()) {
        for (int i = 0; i < 300; ++i) {
            const Eigen::Vector3d ray = random_ray(random, 0.5).normalized();
            const auto sight = project(lens, ray);
            ASSERT_TRUE(sight) << lens.index() << " at " << ray.transpose();
            const auto back = unproject(lens, sight->pixel_px);
            ASSERT_TRUE(back) << lens.index() << " at " << ray.transpose();
            EXPECT_LT((*back - ray).norm(), 1e-9) << lens.index();
        }
    }
}

TEST(Lens, DerivativeIsThatOfTheDifferences) {
    std::mt19937 random(2);
    for (const Lens& lens : vision_test::lenses()) {
        const auto pixel = [&](const Eigen::VectorXd& ray) -> Eigen::VectorXd { return project(lens, ray)->pixel_px; };
        for (int i = 0; i < 20; ++i) {
            const Eigen::Vector3d ray = random_ray(random, 0.5);
            EXPECT_TRUE(test::jacobian_matches(pixel, project(lens, ray)->by_ray, ray, 1e-4)) << lens.index();
        }
        const Eigen::Vector3d axis(0, 0, 2);
        EXPECT_TRUE(test::jacobian_matches(pixel, project(lens, axis)->by_ray, axis, 1e-4)) << lens.index();
    }
}

TEST(Lens, PinholeByHand) {
    // x = 0.5, y = -0.25: r2 = 0.3125, s = 1 + 0.1 r2 = 1.03125; with p1 = 0.01 and p2 = 0.02
    // x'' = 0.515625 + 2 p1 x y + p2 (r2 + 2 x2) = 0.529375; y'' = -0.2578125 + p1 (r2 + 2 y2) + 2 p2 x y = -0.2584375.
    const PinholeLens lens{{100, 200}, {10, 20}, {0.1}, {0.01, 0.02}};
    const auto sight = project(lens, {1, -0.5, 2});
    ASSERT_TRUE(sight);
    EXPECT_NEAR(sight->pixel_px.x(), 62.9375, 1e-9);
    EXPECT_NEAR(sight->pixel_px.y(), -31.6875, 1e-9);
}

TEST(Lens, FisheyeByHand) {
    // 45 degrees to the right: theta = pi/4, theta_d = theta (1 + 0.1 theta^2).
    const double theta = std::atan(1.0);
    const auto sight = project(FisheyeLens{{100, 100}, {0, 0}, {0.1}}, {3, 0, 3});
    ASSERT_TRUE(sight);
    EXPECT_NEAR(sight->pixel_px.x(), 100 * theta * (1 + 0.1 * theta * theta), 1e-9);
    EXPECT_NEAR(sight->pixel_px.y(), 0, 1e-9);
}

TEST(Lens, FisheyeSeesBehindItself) {
    const Lens fisheye = FisheyeLens{{300, 300}, {600, 600}, {}};
    const Eigen::Vector3d behind = Eigen::Vector3d(1, 0.2, -0.3).normalized();
    const auto sight = project(fisheye, behind);
    ASSERT_TRUE(sight);
    const auto back = unproject(fisheye, sight->pixel_px);
    ASSERT_TRUE(back);
    EXPECT_LT((*back - behind).norm(), 1e-9);
    EXPECT_FALSE(unproject(fisheye, {600 + 300 * 3.2, 600})) << "more than half a turn from the axis";
    EXPECT_FALSE(project(fisheye, {0, 0, -1}));
}

TEST(Lens, NothingBehindAndNothingFoldedBack) {
    const auto lenses = vision_test::lenses();
    for (const Lens& lens : lenses) {
        EXPECT_TRUE(!project(lens, {0.1, 0.1, -1}) || std::holds_alternative<FisheyeLens>(lens)) << lens.index();
        EXPECT_FALSE(project(lens, {0, 0, -1})) << lens.index();
    }
    // k1 = -0.32, k2 = 0.12, k3 = -0.01: what is shown turns back before a slope of 6 and again falls to zero there.
    EXPECT_FALSE(project(lenses[1], {7, 0, 1}));
    // kappa1 = -0.062 turns back at a distorted radius of 2.32 mm, 1.55 mm straight: a slope of 0.42.
    const Lens barrel = TsaiLens{3.7, -6.2e-2, {4.65e-3, 4.65e-3}, {0, 0}};
    EXPECT_TRUE(project(barrel, {0.41, 0, 1}));
    EXPECT_FALSE(project(barrel, {0.43, 0, 1}));
    EXPECT_FALSE(unproject(barrel, {600, 0})) << "2.79 mm from the centre";
}

TEST(Lens, NumbersThatAreNoneGiveNothing) {
    const double nan = std::nan(""), huge = 1e300;
    for (const Lens& lens : vision_test::lenses()) {
        EXPECT_FALSE(project(lens, {nan, 0, 1}));
        EXPECT_FALSE(project(lens, {0, 0, 0}));
        EXPECT_FALSE(unproject(lens, {nan, 0}));
        EXPECT_TRUE(!unproject(lens, {huge, huge}) || !std::holds_alternative<FisheyeLens>(lens)) << lens.index();
    }
    EXPECT_FALSE(unproject(PinholeLens{{0, 0}, {0, 0}, {}, {}}, {5, 5})) << "no focal length";
}

TEST(Lens, ScaledShowsTheSameInAnotherImage) {
    const Eigen::Vector2d factor(0.625, 0.5);
    for (const Lens& lens : vision_test::lenses()) {
        const Eigen::Vector3d ray(0.2, -0.1, 1);
        const Eigen::Vector2d wanted_px = project(lens, ray)->pixel_px.cwiseProduct(factor);
        EXPECT_LT((project(scaled(lens, factor), ray)->pixel_px - wanted_px).norm(), 1e-9) << lens.index();
    }
}

} // namespace
} // namespace locus::vision
