// Strapdown mechanisation against a path whose derivatives are known, and its Jacobian against differences.
#include "fusion/inertial/strapdown.h"
#include "tests/unit/fusion/jacobian.h"
#include "tests/unit/fusion/simulated_flight.h"
#include "tests/unit/fusion/simulated_tag.h"

#include <gtest/gtest.h>

namespace locus::inertial {
namespace {

using Vector15 = Eigen::Matrix<double, navigation_size, 1>;

/// Carried by samples alone, held and caught up as the track does.
double error_after_m(double imu_hz, double seconds) {
    const Site site = test::hall();
    test::FlightSettings clean;
    clean.force_noise_mps2_rthz = clean.rate_noise_radps_rthz = 0;
    clean.force_bias_mps2.setZero();
    clean.rate_bias_radps.setZero();
    test::SimulatedFlight flight(site, clean, 1);
    HeldImu imu;
    const double from_s = 3, step_s = 1 / imu_hz;
    Motion motion{flight.position_m(from_s), flight.velocity_mps(from_s), flight.body_to_site(from_s)};
    imu.take(flight.imu_sample(from_s), timestamp_from_s(from_s));
    for (double t = from_s + step_s; t < from_s + seconds + step_s / 2; t += step_s) {
        move(motion, imu.rates(), step_s);
        if (const auto lag = imu.take(flight.imu_sample(t), timestamp_from_s(t))) catch_up(motion, *lag);
    }
    return (motion.position_site_m - flight.position_m(from_s + seconds)).norm();
}

TEST(Strapdown, FollowsAPathOnSamplesAlone) {
    EXPECT_LT(error_after_m(100, 10), 0.02);
    EXPECT_LT(error_after_m(20, 10), 0.4);
    EXPECT_LT(error_after_m(400, 10), error_after_m(100, 10));
}

/// Errors as the filter defines them: added to the truth, and the attitude's as a small turn in the site frame.
struct Errors {
    Motion motion;
    Rates rates;
    double dt_s;

    Vector15 after(const Vector15& error) const {
        Motion disturbed = motion;
        for (int i = 0; i < 3; ++i) {
            disturbed.position_site_m(i) += error(3 * i);
            disturbed.velocity_site_mps(i) += error(3 * i + 1);
        }
        disturbed.body_to_site = rotation(Eigen::Vector3d(error(2), error(5), error(8))) * motion.body_to_site;
        Motion exact = motion;
        move(disturbed,
             {rates.specific_force_mps2 - error.segment<3>(accelerometer_bias_at),
              rates.angular_rate_radps - error.segment<3>(gyroscope_bias_at)},
             dt_s);
        move(exact, rates, dt_s);
        const Eigen::AngleAxisd turn(disturbed.body_to_site * exact.body_to_site.conjugate());
        const Eigen::Vector3d attitude = turn.angle() * turn.axis();
        Vector15 result = error; // biases stay
        for (int i = 0; i < 3; ++i) {
            result(3 * i) = disturbed.position_site_m(i) - exact.position_site_m(i);
            result(3 * i + 1) = disturbed.velocity_site_mps(i) - exact.velocity_site_mps(i);
            result(3 * i + 2) = attitude(i);
        }
        return result;
    }
};

TEST(Strapdown, ErrorTransitionIsItsJacobian) {
    const Errors errors{{{1, 2, 3}, {0.5, -0.2, 0.1}, Eigen::Quaterniond(0.8, 0.3, -0.4, 0.33).normalized()},
                        {{0.4, -0.8, 9.6}, {0.3, -0.2, 0.5}},
                        0.005};
    const ErrorTransition analytic = error_transition(errors.motion, errors.rates, errors.dt_s);
    const auto function = [&](const Eigen::VectorXd& error) -> Eigen::VectorXd { return errors.after(error); };
    // The turn during the step is left out of the Jacobian: a thousandth of what the step does.
    EXPECT_TRUE(test::jacobian_matches(function, analytic, Eigen::VectorXd::Zero(navigation_size), 1e-4, 1e-5));
}

TEST(Strapdown, NoiseIsPositiveSemiDefinite) {
    const ErrorTransition noise = error_noise({0.1, 0.01, 0.001, 0.0001}, 0.01);
    EXPECT_EQ(noise, ErrorTransition(noise.transpose()));
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<ErrorTransition>(noise).eigenvalues().minCoeff(), -1e-18);
}

TEST(HeldImu, AGapIsNotJoinedByAStraightLine) {
    HeldImu imu;
    ImuSample sample;
    EXPECT_FALSE(imu.is_fresh(timestamp_from_s(1)));
    EXPECT_FALSE(imu.take(sample, timestamp_from_s(1)).has_value());
    sample.specific_force_mps2 = {1, 0, 0};
    const auto lag = imu.take(sample, timestamp_from_s(1.01));
    ASSERT_TRUE(lag.has_value());
    EXPECT_EQ(lag->difference.specific_force_mps2.x(), 1); // NOLINT(bugprone-unchecked-optional-access): asserted
    EXPECT_TRUE(imu.is_fresh(timestamp_from_s(1.2)));
    EXPECT_FALSE(imu.is_fresh(timestamp_from_s(1.22)));
    EXPECT_FALSE(imu.take(sample, timestamp_from_s(1.3)).has_value());
}

} // namespace
} // namespace locus::inertial
