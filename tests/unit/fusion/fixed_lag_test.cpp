// The window that looks back: right where the model is right, empty after a jump, and part of the engine's step.
#include "fusion/filter/fixed_lag.h"

#include "fusion/engine.h"
#include "tests/unit/fusion/simulated_tag.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

namespace locus::filter {
namespace {

using Matrix2 = Eigen::Matrix2d;
using Vector2 = Eigen::Vector2d;

constexpr double lag_dt_s = 0.1, acceleration_density = 0.5, position_sigma_m = 0.3;

/// One axis of a body whose velocity wanders, its Kalman filter, and the same as an Estimate.
struct WanderingAxis {
    Vector2 truth{0, 0}, state{0, 0};
    Matrix2 covariance = Matrix2::Identity();
    Matrix2 f = (Matrix2() << 1, lag_dt_s, 0, 1).finished();
    Matrix2 q = acceleration_density * (Matrix2() << lag_dt_s * lag_dt_s * lag_dt_s / 3, lag_dt_s* lag_dt_s / 2,
                                        lag_dt_s* lag_dt_s / 2, lag_dt_s)
                                           .finished();

    void move(std::mt19937_64& random) {
        std::normal_distribution<double> unit(0, 1);
        truth = f * truth + Matrix2(q.llt().matrixL()) * Vector2(unit(random), unit(random));
        state = f * state;
        covariance = f * covariance * f.transpose() + q;
    }
    void measure(std::mt19937_64& random) {
        std::normal_distribution<double> noise(0, position_sigma_m);
        const Vector2 gain = covariance.col(0) / (covariance(0, 0) + position_sigma_m * position_sigma_m);
        state += gain * (truth(0) + noise(random) - state(0));
        covariance -= gain * covariance.row(0).eval();
    }
};

Estimate estimate_of(const WanderingAxis& axis, double time_s) {
    Estimate estimate;
    estimate.missing = Missing::nothing;
    estimate.time = timestamp_from_s(time_s);
    for (std::size_t i = 0; i < 3; ++i) { // the same in x, y and z
        estimate.position_site_m[i] = axis.state(0);
        estimate.velocity_site_mps[i] = axis.state(1);
        estimate.covariance[7 * i] = axis.covariance(0, 0);
        estimate.covariance[7 * i + 3] = estimate.covariance[7 * i + 18] = axis.covariance(0, 1);
        estimate.covariance[7 * (i + 3)] = axis.covariance(1, 1);
    }
    return estimate;
}

/// Mean over 200 walks of 3 s each: NEES of two numbers, mean 2, standard deviation of that mean 2 / sqrt(200) = 0.14;
/// and of the same moment the filter's own error is the larger one.
TEST(FixedLag, KnowsBetterAndKnowsHowWell) {
    std::mt19937_64 random(5);
    double nees = 0, smoothed_m2 = 0, filtered_m2 = 0;
    constexpr int walks = 200, ticks = 10;
    for (int walk = 0; walk < walks; ++walk) {
        WanderingAxis axis;
        axis.truth = Vector2(1, 1).cwiseProduct(
            Vector2(std::normal_distribution<>()(random), std::normal_distribution<>()(random)));
        FixedLag lag(ticks);
        std::vector<WanderingAxis> past;
        for (int k = 0; k < 30; ++k) {
            axis.move(random);
            const Estimate foreseen = estimate_of(axis, k * lag_dt_s);
            axis.measure(random);
            past.push_back(axis);
            lag.add(estimate_of(axis, k * lag_dt_s), foreseen);
        }
        const auto then = lag.smoothed();
        ASSERT_TRUE(then.has_value());
        const WanderingAxis& was = past[past.size() - 1 - ticks];
        EXPECT_EQ(then->time, timestamp_from_s((29 - ticks) * lag_dt_s));
        const Vector2 error = Vector2(then->position_site_m[1], then->velocity_site_mps[1]) - was.truth;
        const Matrix2 spread =
            (Matrix2() << then->covariance[7], then->covariance[10], then->covariance[10], then->covariance[28])
                .finished();
        nees += error.dot(spread.ldlt().solve(error)) / walks;
        smoothed_m2 += error(0) * error(0) / walks;
        filtered_m2 += std::pow(was.state(0) - was.truth(0), 2) / walks;
    }
    EXPECT_NEAR(nees, 2, 3 * 0.14);
    EXPECT_LT(smoothed_m2, 0.6 * filtered_m2);
}

TEST(FixedLag, AJumpOrNoPositionEmptiesTheWindow) {
    std::mt19937_64 random(6);
    WanderingAxis axis;
    FixedLag lag(2);
    const auto add = [&](double time_s, std::uint32_t resets, Missing missing = Missing::nothing) {
        Estimate estimate = estimate_of(axis, time_s);
        estimate.reset_count = resets;
        estimate.missing = missing;
        lag.add(estimate, estimate);
        return lag.smoothed().has_value();
    };
    EXPECT_FALSE(add(0, 0));
    EXPECT_FALSE(add(1, 0));
    EXPECT_TRUE(add(2, 0));
    EXPECT_FALSE(add(3, 1));
    EXPECT_FALSE(add(4, 1));
    EXPECT_TRUE(add(5, 1));
    EXPECT_FALSE(add(6, 1, Missing::fresh_measurements));
    EXPECT_FALSE(add(7, 1));
}

/// The default estimator's own poses are the measure: half a second later they are known better, and the bound says so.
TEST(FixedLag, TheEngineTellsWhereTargetsWere) {
    constexpr double lag_s = 0.5, step_s = 0.01;
    EngineSettings settings;
    settings.site = test::hall();
    settings.targets = {{"tag", address(9), ""}};
    settings.fusion.smooth_lag_s = lag_s;
    Engine engine(settings);
    test::SimulatedTag tag(settings.site, RangeEkfSettings{}, 8);
    std::vector<Eigen::Vector3d> truth, live;
    double live_m2 = 0, smoothed_m2 = 0;
    int within = 0, count = 0;
    for (int k = 1; k <= 3000; ++k) {
        tag.move(step_s);
        engine.submit(tag.range(static_cast<std::size_t>(k) % 8), timestamp_from_s(tag.time_s()));
        const auto poses = engine.step(timestamp_from_s(tag.time_s()));
        truth.push_back(tag.motion().row(0));
        live.push_back(vector(poses[0].estimate.position_site_m));
        for (const Pose& pose : engine.smoothed()) {
            EXPECT_NEAR(to_s(pose.estimate.time), tag.time_s() - lag_s, 1e-6);
            const Eigen::Vector3d was = truth[truth.size() - 51];
            const Eigen::Vector3d error = vector(pose.estimate.position_site_m) - was;
            smoothed_m2 += error.squaredNorm();
            live_m2 += (live[live.size() - 51] - was).squaredNorm();
            within += error.head<2>().norm() < double{pose.horizontal_error_95_m} ? 1 : 0;
            ++count;
        }
    }
    ASSERT_GT(count, 2500);
    std::printf("half a second later: %.3f m in place of %.3f m, bound held %.1f %%\n", std::sqrt(smoothed_m2 / count),
                std::sqrt(live_m2 / count), 100.0 * within / count);
    EXPECT_LT(smoothed_m2, 0.9 * live_m2);
    EXPECT_GT(within, 0.9 * count);
}

} // namespace
} // namespace locus::filter
