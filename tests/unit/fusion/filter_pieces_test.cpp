// The small pieces every filter is made of: weights, gate, motion.
#include "fusion/filter/gate.h"
#include "fusion/filter/motion.h"
#include "fusion/filter/robust_gain.h"
#include "tests/support/heavy.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <random>

namespace locus::filter {
namespace {

TEST(RobustGain, CauchyIsOneAtZeroHalfAtItsScaleAndDiesAsTheSquare) {
    EXPECT_DOUBLE_EQ(cauchy_weight(0, 2), 1);
    EXPECT_DOUBLE_EQ(cauchy_weight(-2, 2), 0.5);
    EXPECT_NEAR(cauchy_weight(2000, 2), 1e-6, 1e-11);
}

struct Normal {
    std::mt19937 random{7};
    std::normal_distribution<double> normal;
    double operator()() { return normal(random); }
};

// The square of what is left of a scalar error, drawn at random, against what the credits say is left.
TEST(RobustGain, CreditIsWhatTheWeightedStepsAreWorthUnderTheNoiseItIsTold) {
    for (const double scale : {0.5, 1.0, 2.0}) {
        Normal draw;
        RobustGain gain(scale);
        double left = 0, credited = 0;
        constexpr int trials = 200'000;
        for (int i = 0; i < trials; ++i) {
            const double error = draw(),
                         innovation = error + draw(); // the gain of Kalman is a half, and so is the rest
            const Share share = gain.weigh(innovation / std::sqrt(2.0));
            left += std::pow(error - 0.5 * share.step * innovation, 2);
            credited += 1 - 0.5 * share.credit;
        }
        EXPECT_NEAR(left / trials, credited / trials, 0.01) << scale;
        EXPECT_NEAR(gain.spread(), 1, 0.15) << scale;
    }
}

TEST(RobustGain, WithoutLimitItIsKalmans) {
    RobustGain gain(1e6);
    const Share share = gain.weigh(3);
    EXPECT_NEAR(share.step, 1, 1e-9);
    EXPECT_NEAR(share.credit, 1, 1e-9);
}

TEST(RobustGain, FarIsMeasuredInWhatInnovationsComeTo) {
    Normal draw;
    RobustGain gain(1);
    EXPECT_NEAR(gain.weigh(0.7).step, 1 / 1.49, 1e-9);
    for (int i = 0; i < 5000; ++i) gain.weigh(0.7 * draw());
    EXPECT_NEAR(gain.spread(), 0.7, 0.1);
    EXPECT_NEAR(gain.weigh(gain.spread()).step, 0.5, 1e-9);
}

TEST(RobustGain, OneOutlierInTenHardlyMovesTheSpread) {
    Normal draw;
    RobustGain gain(1);
    for (int i = 0; i < 5000; ++i) gain.weigh(i % 10 == 0 ? 30 : draw());
    EXPECT_NEAR(gain.spread(), 1.2, 0.15);
}

TEST(RobustGain, SpreadIsBelievedWithinAFactorOfTwo) {
    RobustGain still(1), wild(1);
    for (int i = 0; i < 5000; ++i) {
        still.weigh(0);
        wild.weigh(50);
    }
    EXPECT_EQ(still.spread(), 0.5);
    EXPECT_EQ(wild.spread(), 2);
}

TEST(Gate, LimitIsTheNormalQuantile) {
    EXPECT_NEAR(gate_in_sigma(0.05), 1.959964, 1e-6);
    EXPECT_NEAR(gate_in_sigma(1e-3), 3.290527, 1e-6);
    EXPECT_NEAR(gate_in_sigma(1e-9), 6.109410, 1e-5);
}

TEST(Gate, RefusesWhatIsFarOutAndReopensAfterItsPatience) {
    Gate gate;
    EXPECT_TRUE(gate.passes(-3.2, 3.3, 4));
    for (int i = 0; i < 4; ++i) EXPECT_FALSE(gate.passes(-9, 3.3, 4)) << i;
    EXPECT_TRUE(gate.passes(-9, 3.3, 4)) << "shut for ever";
    EXPECT_FALSE(gate.passes(-9, 3.3, 4)) << "one only, then it counts anew";
}

TEST(Gate, AGoodOneMakesItForget) {
    Gate gate;
    for (int i = 0; i < 3; ++i) EXPECT_FALSE(gate.passes(5, 3, 3));
    EXPECT_EQ(gate.refused_in_a_row(), 3u);
    EXPECT_TRUE(gate.passes(0, 3, 3));
    EXPECT_EQ(gate.refused_in_a_row(), 0u);
}

TEST(Gate, NaNNeverPassesAsGood) {
    Gate gate;
    EXPECT_FALSE(gate.passes(std::nan(""), 3, 10));
}

double seconds(int least_exponent, int most_exponent) {
    const int exponent = *rc::gen::inRange(least_exponent, most_exponent);
    return *rc::gen::inRange(100, 1000) / 100.0 * std::pow(10.0, exponent);
}

// Two steps must be one: the transition composes and the noise of the first is carried through the second.
TEST(AxisStep, TwoStepsAreOneStep) {
    EXPECT_TRUE(rc::check([] {
        const MotionModel model{1.7, seconds(-1, 3)};
        const double first_s = seconds(-4, -1), second_s = seconds(-4, -1);
        const AxisStep a = axis_step(model, first_s), b = axis_step(model, second_s);
        const AxisStep both = axis_step(model, first_s + second_s);
        const Eigen::Matrix3d noise = b.transition * a.noise * b.transition.transpose() + b.noise;
        RC_ASSERT((b.transition * a.transition - both.transition).norm() < 1e-9);
        // The quadrature is exact to the 7th power of step over time; both steps are under twenty times the time.
        RC_ASSERT((noise - both.noise).norm() < 1e-6 * both.noise.norm() ||
                  first_s + second_s > model.acceleration_time_s);
    }));
}

TEST(AxisStep, NoiseIsPositiveSemiDefiniteForAnyStep) {
    EXPECT_TRUE(rc::check([] {
        const AxisStep step = axis_step({2, seconds(-2, 3)}, seconds(-6, 3));
        const Eigen::VectorXd eigenvalues = test::eigenvalues(step.noise);
        RC_ASSERT(step.noise == step.noise.transpose());
        RC_ASSERT(eigenvalues.minCoeff() >= -1e-12 * eigenvalues.maxCoeff());
    }));
}

TEST(AxisStep, LongDecayIsConstantAccelerationAndWhiteJerk) {
    const double dt = 0.1, time = 1e4;
    const AxisStep step = axis_step({2, time}, dt);
    EXPECT_NEAR(step.transition(0, 2), dt * dt / 2, 1e-7);
    EXPECT_NEAR(step.transition(1, 2), dt, 1e-6);
    const double jerk_density = 2 * 2.0 * 2.0 / time;
    EXPECT_NEAR(step.noise(0, 0), jerk_density * std::pow(dt, 5) / 20, 1e-4 * jerk_density * std::pow(dt, 5));
    EXPECT_NEAR(step.noise(2, 2), jerk_density * dt, 1e-4 * jerk_density * dt);
}

TEST(AxisStep, NoTimeChangesNothing) {
    const AxisStep step = axis_step({2, 1}, 0);
    EXPECT_EQ(step.transition, Eigen::Matrix3d::Identity());
    EXPECT_EQ(step.noise, Eigen::Matrix3d::Zero());
}

TEST(WanderStep, SettlesAtItsSigmaWhateverTheStep) {
    for (const double dt : {0.001, 0.1, 10.0}) {
        double variance = 0;
        for (double t = 0; t < 20; t += dt) {
            const WanderStep step = wander_step(0.2, 0.5, dt);
            variance = step.keep * step.keep * variance + step.variance;
        }
        EXPECT_NEAR(variance, 0.04, 1e-9) << dt;
    }
}

} // namespace
} // namespace locus::filter
