#include "fusion/filter/particles.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace locus::filter {
namespace {

using Vector4 = Particles::Vector4;
using Matrix4 = Particles::Matrix4;

Particles cloud_at(const Vector4& mean, double sigma, ParticleSettings settings = {}) {
    Particles cloud(settings);
    cloud.start(mean, sigma * sigma * Matrix4::Identity());
    cloud.settle();
    return cloud;
}

TEST(Lanes, ExponentialIsThatOfTheLibrary) {
    for (float x = -79; x <= 0; x += 0.0137f)
        EXPECT_NEAR(double{exp_of_negative(x)} / std::exp(double{x}), 1, 1e-5) << x;
    EXPECT_GT(exp_of_negative(-1e9f), 0);
}

/// 8e6 numbers: the mean is known to 0.00035, the variance to 0.0004, both tested at four of these.
TEST(Lanes, TheBellHasMeanZeroAndVarianceOne) {
    LaneRandom random(3);
    double sum = 0, squares = 0;
    constexpr int draws = 1000000;
    for (int i = 0; i < draws; ++i)
        for (const float value : random.bell()) {
            sum += double{value};
            squares += double{value} * double{value};
        }
    const double count = 8.0 * draws;
    EXPECT_NEAR(sum / count, 0, 0.0015);
    EXPECT_NEAR(squares / count, 1, 0.002);
}

/// Moments of 1,000 draws: the mean within 4 sigma / sqrt(1000), the variance within a fifth.
TEST(Particles, StartAsToldAndMoveAsComplexNumbers) {
    Particles cloud = cloud_at({10, -5, 1, 0}, 0.1);
    EXPECT_LT((cloud.mean() - Vector4(10, -5, 1, 0)).norm(), 0.03);
    EXPECT_NEAR(cloud.covariance()(0, 0), 0.01, 0.002);
    cloud.move({{0, 2}}); // two metres where each one's left is
    cloud.settle();
    EXPECT_LT((cloud.mean() - Vector4(10, -3, 1, 0)).norm(), 0.05);
    EXPECT_NEAR(cloud.covariance()(0, 0), 0.05, 0.01); // the drives' spread came in: 0.01 + 4 * 0.01
}

/// Against Kalman's answer for one range from afar, where it is linear.
TEST(Particles, ARangeWeighsAsKalmanSays) {
    ParticleSettings settings;
    settings.max_count = 20000;
    Particles cloud = cloud_at({0, 0, 1, 0}, 1, settings);
    ParticleNoise noise;
    noise.sigma_m = 0.5;
    noise.outlier_share = 1e-6;
    cloud.weigh_range({-100, 0}, 0, 101, noise);
    EXPECT_TRUE(cloud.settle());
    EXPECT_NEAR(cloud.mean()(0), 0.8, 0.03);
    EXPECT_NEAR(cloud.covariance()(0, 0), 0.2, 0.02);
    EXPECT_NEAR(cloud.covariance()(1, 1), 1, 0.05);
    cloud.weigh_difference({0, -100}, 0, {0, 100}, 0, -1, noise); // twice as steep
    EXPECT_TRUE(cloud.settle());
    EXPECT_NEAR(cloud.mean()(1), 0.5 * 16 / 17, 0.03);
}

TEST(Particles, ResamplingKeepsTheMomentsAndTheCountFollowsTheSpread) {
    Particles cloud = cloud_at({0, 0, 1, 0}, 1);
    ParticleNoise noise;
    noise.sigma_m = 0.3;
    cloud.weigh_range({-100, 0}, 0, 100.5, noise);
    cloud.settle();
    const Vector4 mean = cloud.mean();
    const Matrix4 covariance = cloud.covariance();
    ASSERT_LT(cloud.effective_size(), 500);
    cloud.resample_if_poor();
    EXPECT_EQ(cloud.size(), 1000u) << "wide: all are wanted";
    cloud.settle();
    EXPECT_LT((cloud.mean() - mean).norm(), 0.15);
    EXPECT_NEAR(cloud.covariance()(0, 0) / covariance(0, 0), 1, 0.25);
    Particles sure = cloud_at({0, 0, 1, 0}, 0.05);
    noise.sigma_m = 0.02;
    sure.weigh_range({-100, 0}, 0, 100, noise);
    sure.settle();
    sure.resample_if_poor();
    EXPECT_EQ(sure.size(), 250u) << "narrow: a few bins";
}

TEST(Particles, AWallStopsThoseThatCrossItAndNoOthers) {
    Particles cloud = cloud_at({0, 0, 1, 0}, 0.3);
    cloud.move({{1, 0}});
    cloud.begin_walls();
    cloud.hit_wall({1, 0}, {1, 5}); // only the upper half of the way is walled
    cloud.end_walls();
    ASSERT_TRUE(cloud.settle());
    EXPECT_LT(cloud.mean()(1), -0.03);
    Particles shut = cloud_at({0, 0, 1, 0}, 0.01);
    shut.move({{1, 0}});
    shut.begin_walls();
    shut.hit_wall({0.5, -5}, {0.5, 5});
    shut.end_walls();
    ASSERT_TRUE(shut.settle());
    EXPECT_NEAR(shut.mean()(0), 1, 0.02) << "a door that the plan does not know";
}

TEST(Particles, FarPlacesAndNonsenseDoNoHarm) {
    Particles cloud = cloud_at({0, 0, 1, 0}, 0.1);
    cloud.weigh_range({0, 0}, 0, 1e30, {});
    cloud.settle();
    EXPECT_TRUE(cloud.mean().allFinite());
    for (int i = 0; i < 2000; ++i) cloud.widen(1.1);
    cloud.weigh_range({0, 0}, 0, 1, {});
    cloud.settle();
    EXPECT_GT(cloud.size(), 0u);
}

} // namespace
} // namespace locus::filter
