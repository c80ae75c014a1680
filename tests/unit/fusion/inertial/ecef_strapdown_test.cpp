// Mechanisation in the Earth-fixed frame: against a drive whose derivatives are known, at rest, against fine steps
// where rates change, and its Jacobians against differences.
#include "fusion/inertial/ecef_strapdown.h"
#include "tests/unit/fusion/jacobian.h"
#include "tests/unit/fusion/simulated_drive.h"

#include <gtest/gtest.h>

namespace locus::inertial {
namespace {

using Vector15 = Eigen::Matrix<double, navigation_size, 1>;

EcefMotion carried_on_samples(test::SimulatedDrive& drive, int samples, double step_s) {
    HeldImu imu;
    EcefMotion motion = drive.motion();
    imu.take(drive.exact_imu(), drive.now());
    for (int i = 0; i < samples; ++i) {
        const Rates held = imu.rates();
        move(motion, held, step_s);
        drive.move();
        if (const auto lag = imu.take(drive.exact_imu(), drive.now())) catch_up(motion, held, *lag);
    }
    return motion;
}

TEST(EcefStrapdown, FollowsADriveOnSamplesAlone) {
    const Site site = test::town();
    test::SimulatedDrive drive(site, {}, 1);
    const EcefMotion motion = carried_on_samples(drive, 4000, 0.01);
    EXPECT_LT((motion.position_ecef_m - drive.motion().position_ecef_m).norm(), 0.02);
    EXPECT_LT(motion.body_to_ecef.angularDistance(drive.motion().body_to_ecef), 1e-5);
}

// Without the Earth's rate the heading would be off by 2.5 mrad, and the velocity by centimetres a second.
TEST(EcefStrapdown, StandsStillOnTheTurningEarth) {
    const Site site = test::town();
    test::DriveSettings standing;
    standing.still_until_s = 1e6;
    test::SimulatedDrive drive(site, standing, 1);
    const EcefMotion motion = carried_on_samples(drive, 6000, 0.01);
    EXPECT_LT(motion.velocity_ecef_mps.norm(), 1e-6);
    EXPECT_LT(motion.body_to_ecef.angularDistance(drive.motion().body_to_ecef), 1e-8);
}

// Rates that run straight during a step, once in one step that is caught up and once in ten thousand. What is left is
// of the third order in the step: a tenth of the step leaves a thousandth.
TEST(EcefStrapdown, CatchesUpConingAndScullingToTheSecondOrder) {
    const Rates first{{1, -2, 9}, {0.5, -0.8, 1.1}}, last{{-2, 1, 11}, {-0.9, 0.7, 0.4}};
    const auto missed = [&](double step_s) {
        const EcefMotion begin{
            {-3.96e6, 3.35e6, 3.7e6}, {0, 0, 0}, Eigen::Quaterniond(0.8, 0.1, -0.5, 0.3).normalized()};
        EcefMotion one = begin, fine = begin;
        move(one, first, step_s);
        catch_up(
            one, first,
            {{last.specific_force_mps2 - first.specific_force_mps2, last.angular_rate_radps - first.angular_rate_radps},
             step_s});
        constexpr int parts = 10000;
        for (int i = 0; i < parts; ++i) {
            const double share = (i + 0.5) / parts;
            move(fine,
                 {first.specific_force_mps2 + share * (last.specific_force_mps2 - first.specific_force_mps2),
                  first.angular_rate_radps + share * (last.angular_rate_radps - first.angular_rate_radps)},
                 step_s / parts);
        }
        return Eigen::Vector2d((one.velocity_ecef_mps - fine.velocity_ecef_mps).norm(),
                               one.body_to_ecef.angularDistance(fine.body_to_ecef));
    };
    const Eigen::Vector2d coarse = missed(0.2), finer = missed(0.02);
    EXPECT_LT(coarse(0), 0.03);
    EXPECT_LT(coarse(1), 2e-3);
    EXPECT_LT(finer(0), coarse(0) / 500);
    EXPECT_LT(finer(1), coarse(1) / 500);
}

TEST(EcefStrapdown, GravityGradientIsGravitysToAHundredth) {
    const Eigen::Vector3d place(-3961765, 3349009, 3698311);
    const auto gravity = [](const Eigen::VectorXd& p) -> Eigen::VectorXd { return gravity_ecef_mps2(p.head<3>()); };
    EXPECT_TRUE(test::jacobian_matches(gravity, gravity_gradient(place), place, 0.01 * 3.1e-6, 100));
}

/// Errors as the filter defines them: added to the truth, and the attitude's as a small turn in ECEF.
Vector15 error_after(const EcefMotion& motion, const Rates& rates, double dt_s, const Vector15& error) {
    EcefMotion disturbed = motion, exact = motion;
    for (int i = 0; i < 3; ++i) {
        disturbed.position_ecef_m(i) += error(3 * i);
        disturbed.velocity_ecef_mps(i) += error(3 * i + 1);
    }
    disturbed.body_to_ecef = rotation(Eigen::Vector3d(error(2), error(5), error(8))) * motion.body_to_ecef;
    move(disturbed,
         {rates.specific_force_mps2 - error.segment<3>(accelerometer_bias_at),
          rates.angular_rate_radps - error.segment<3>(gyroscope_bias_at)},
         dt_s);
    move(exact, rates, dt_s);
    const Eigen::AngleAxisd turn(disturbed.body_to_ecef * exact.body_to_ecef.conjugate());
    const Eigen::Vector3d attitude = turn.angle() * turn.axis();
    Vector15 result = error;
    for (int i = 0; i < 3; ++i) {
        result(3 * i) = disturbed.position_ecef_m(i) - exact.position_ecef_m(i);
        result(3 * i + 1) = disturbed.velocity_ecef_mps(i) - exact.velocity_ecef_mps(i);
        result(3 * i + 2) = attitude(i);
    }
    return result;
}

// The transition leaves out the second order in velocity: dt^2 |f| / 2. A position of 4e6 m over steps of 1e-4 m is
// rounded to 3e-6.
TEST(EcefStrapdown, ErrorTransitionIsItsDifferences) {
    const EcefMotion motion{
        {-3.96e6, 3.35e6, 3.7e6}, {12, -7, 3}, Eigen::Quaterniond(0.8, 0.1, -0.5, 0.3).normalized()};
    const Rates rates{{1, -2, 9}, {0.05, -0.08, 0.3}};
    for (const double dt_s : {1e-3, 1e-2}) {
        const auto function = [&](const Eigen::VectorXd& error) -> Eigen::VectorXd {
            return error_after(motion, rates, dt_s, error);
        };
        EXPECT_TRUE(test::jacobian_matches(function, error_transition(motion, rates, dt_s), Eigen::VectorXd::Zero(15),
                                           6 * dt_s * dt_s + 3e-6, 1e-4));
    }
}

} // namespace
} // namespace locus::inertial
