#include "fusion/inertial/pedestrian.h"
#include "tests/unit/fusion/inertial/simulated_walker.h"

#include <gtest/gtest.h>

#include <numbers>

namespace locus::inertial {
namespace {

using test::SimulatedWalker;
using test::WalkerModel;

double between(double a, double b) { return std::remainder(a - b, 2 * std::numbers::pi); }

/// Walks for `seconds`, a quarter turn to the left in every ten; returns the steps told.
template <class OnStep>
int walk(SimulatedWalker& walker, Pedestrian& pedestrian, double seconds, const OnStep& on_step) {
    int told = 0;
    for (const double end_s = walker.time_s() + seconds; walker.time_s() < end_s;) {
        const bool turning = std::fmod(walker.time_s(), 10) > 9;
        const ImuSample sample = walker.move(turning ? 0.5 * std::numbers::pi : 0);
        if (const auto step = pedestrian.hear(sample, walker.time())) {
            ++told;
            on_step(*step);
        }
    }
    return told;
}

TEST(Pedestrian, CountsEveryStepWhicheverWayTheDeviceIsWorn) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        WalkerModel model;
        model.worn = rotation(Eigen::Vector3d(0.3 * seed, -0.2 * seed, 0.1 * seed));
        model.steps_hz = 1.4 + 0.05 * seed;
        SimulatedWalker walker(model, seed);
        Pedestrian pedestrian{PedestrianSettings{}};
        const int told = walk(walker, pedestrian, 60, [](const Step&) {});
        EXPECT_NEAR(told, walker.steps(), 2) << "seed " << seed;
    }
}

TEST(Pedestrian, TellsNoStepOfOneWhoStands) {
    SimulatedWalker walker({}, 3);
    Pedestrian pedestrian{PedestrianSettings{}};
    for (int i = 0; i < 6000; ++i) EXPECT_FALSE(pedestrian.hear(walker.move(0, false), walker.time()));
    EXPECT_TRUE(pedestrian.standing());
}

/// Consistency of the heading after a minute of walking, for the unit the settings speak of. The mean of 60 squares of
/// a standard normal lies within 0.68..1.39 in 95 of 100 cases; the levelled tilt takes part of the bias, so the lower
/// end is left open: a bound that is too wide by half is no lie.
TEST(Pedestrian, HeadingDriftsAsItsVarianceSays) {
    double squares = 0;
    constexpr int runs = 60;
    PedestrianSettings settings;
    settings.attitude.gyro_scale_sigma = 1e-6; // the simulated unit has none
    for (unsigned seed = 1; seed <= runs; ++seed) {
        SimulatedWalker walker({}, seed);
        Pedestrian pedestrian{settings};
        walk(walker, pedestrian, 60, [](const Step&) {});
        const double error = between(pedestrian.heading_rad(), walker.heading_rad());
        squares += error * error / pedestrian.heading_variance_rad2();
    }
    EXPECT_LT(squares / runs, 1.39);
    EXPECT_GT(squares / runs, 0.4);
}

TEST(Pedestrian, StandingShowsTheGyroscopesBias) {
    WalkerModel model;
    model.gyro_bias_radps = 0.01;
    double with_m = 0, without_m = 0;
    for (unsigned seed = 1; seed <= 20; ++seed)
        for (const bool stands_first : {false, true}) {
            SimulatedWalker walker(model, seed);
            Pedestrian pedestrian{PedestrianSettings{}};
            for (int i = 0; i < (stands_first ? 500 : 60); ++i) pedestrian.hear(walker.move(0, false), walker.time());
            walk(walker, pedestrian, 60, [](const Step&) {});
            (stands_first ? with_m : without_m) += std::abs(between(pedestrian.heading_rad(), walker.heading_rad()));
        }
    EXPECT_LT(with_m, 0.5 * without_m);
}

TEST(Pedestrian, ACompassHoldsTheHeadingAndASteelDoorDoesNotTurnIt) {
    for (const bool beside_steel : {false, true}) {
        SimulatedWalker walker({}, 11);
        Pedestrian pedestrian{PedestrianSettings{}};
        for (int i = 0; i < 60000; ++i) {
            ImuSample sample = walker.move(0, i > 200);
            const bool steel = beside_steel && i % 3000 > 2500; // five seconds in thirty, bent by 60 degrees
            sample.magnetic_field_ut = walker.field(steel ? Eigen::Vector3d(25, -15, 20) : Eigen::Vector3d::Zero());
            pedestrian.hear(sample, walker.time());
        }
        EXPECT_LT(std::abs(between(pedestrian.heading_rad(), walker.heading_rad())), 0.15)
            << beside_steel; // 0.08 is sway
        EXPECT_LT(std::sqrt(pedestrian.heading_variance_rad2()), 0.1);
    }
}

TEST(Pedestrian, WithoutACompassTheVarianceGrows) {
    SimulatedWalker walker({}, 11);
    Pedestrian pedestrian{PedestrianSettings{}};
    walk(walker, pedestrian, 10, [](const Step&) {});
    const double early = pedestrian.heading_variance_rad2();
    walk(walker, pedestrian, 100, [](const Step&) {});
    EXPECT_GT(pedestrian.heading_variance_rad2(), 10 * early);
}

TEST(Pedestrian, AGapMakesTheHeadingUncertain) {
    SimulatedWalker walker({}, 5);
    Pedestrian pedestrian{PedestrianSettings{}};
    walk(walker, pedestrian, 5, [](const Step&) {});
    const double before = pedestrian.heading_variance_rad2();
    ImuSample sample = walker.move(0);
    pedestrian.hear(sample, walker.time() + duration_from_s(2));
    EXPECT_GT(pedestrian.heading_variance_rad2(), before + 1);
    EXPECT_FALSE(pedestrian.hear(sample, walker.time())) << "time went back";
}

TEST(StepLength, GrowsAsTheFourthRootAndHasABound) {
    const StepLengthSettings settings;
    EXPECT_DOUBLE_EQ(step_length_m(settings, 16), 2 * settings.factor);
    EXPECT_EQ(step_length_m(settings, -1), 0);
    EXPECT_EQ(step_length_m(settings, 1e9), longest_step_m);
}

TEST(Stance, SeesAFootAtRestInAnyPoseAndNoneThatSwings) {
    StanceDetector stance{foot_stance};
    bool rest = false;
    for (int i = 0; i < 20; ++i) rest = stance.hear({-4.9, 0, -8.5}, {0.01, 0, 0.02}, 0.005);
    EXPECT_TRUE(rest);
    for (int i = 0; i < 20; ++i) rest = stance.hear({-4.9, 6, -8.5}, {0.01, 3, 0.02}, 0.005);
    EXPECT_FALSE(rest);
    EXPECT_FALSE(stance.hear({0, 0, 9.8}, {0, 0, 0}, 10)) << "one sample after a gap is no window";
}

} // namespace
} // namespace locus::inertial
