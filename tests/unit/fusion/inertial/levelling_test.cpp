// What an inertial sensor tells before anything else is known: which way is up, and whether it lies still.
#include "fusion/inertial/levelling.h"
#include "fusion/inertial/rest.h"
#include "fusion/units.h"
#include "tests/unit/fusion/simulated_flight.h"
#include "tests/unit/fusion/simulated_tag.h"

#include <gtest/gtest.h>

namespace locus::inertial {
namespace {

TEST(Levelling, FindsUpWhileTheTargetMoves) {
    const Site site = test::hall();
    test::SimulatedFlight flight(site, {}, 2);
    Levelling levelling;
    EXPECT_FALSE(levelling.is_level());
    for (double t = 5; t < 25; t += 0.01) {
        const ImuSample sample = flight.imu_sample(t);
        levelling.carry({vector(sample.specific_force_mps2), vector(sample.angular_rate_radps)}, 0.01);
    }
    EXPECT_TRUE(levelling.is_level());
    const Eigen::Vector3d up_body = flight.body_to_site(25).conjugate() * Eigen::Vector3d::UnitZ();
    const double tilt_rad = std::acos((levelling.body_to_level() * up_body).z());
    EXPECT_LT(tilt_rad, 3 * levelling.tilt_sigma_rad(1, 0.3));
    EXPECT_LT(tilt_rad, 0.06); // the accelerometer's bias alone makes 0.018
}

/// On a table: gravity, a bias and the noise of a MEMS sensor of the phone class at 100 Hz, times `shaken`.
Rates on_a_table(test::SimulatedFlight& noise, double shaken) {
    const auto three = [&] { return Eigen::Vector3d(noise.draw(), noise.draw(), noise.draw()); };
    return {Eigen::Vector3d(0, 0, standard_gravity_mps2) + 0.02 * shaken * three(),
            Eigen::Vector3d(0.004, -0.003, 0.005) + 0.002 * shaken * three()};
}

TEST(Rest, KnowsTheBiasOfAGyroscopeThatLiesStill) {
    const Site site = test::hall();
    test::SimulatedFlight noise(site, {}, 3);
    Rest rest;
    for (int i = 0; i < 45; ++i) rest.carry(on_a_table(noise, 1), 0.01);
    EXPECT_FALSE(rest.is_at_rest()) << "half a second is not over";
    for (int i = 0; i < 100; ++i) rest.carry(on_a_table(noise, 1), 0.01);
    EXPECT_TRUE(rest.is_at_rest());
    const Eigen::Vector3d bias = rest.gyroscope_bias_radps().value_or(Eigen::Vector3d::Zero());
    EXPECT_LT((bias - Eigen::Vector3d(0.004, -0.003, 0.005)).norm(), 0.002);
    for (int i = 0; i < 20; ++i) rest.carry(on_a_table(noise, 20), 0.01);
    EXPECT_FALSE(rest.is_at_rest()) << "it was picked up";
    EXPECT_TRUE(rest.gyroscope_bias_radps().has_value()) << "and is still known";
}

TEST(Rest, ASteadyFastTurnIsNoRest) {
    Rest rest;
    for (int i = 0; i < 200; ++i) rest.carry({{0, 0, standard_gravity_mps2}, {0, 0, 0.5}}, 0.01);
    EXPECT_FALSE(rest.is_at_rest());
}

} // namespace
} // namespace locus::inertial
