// Strapdown mechanisation on a site: the site is taken as flat and at rest, which on consumer sensors nobody can tell
// from the truth (the Earth turns 0.004 deg/s). Errors of the attitude are small rotations in the site frame:
// true body_to_site = rotation(error) * body_to_site (Groves 2013, chapter 14; Sola 2017, section 7).
#pragma once

#include "fusion/inertial/held_imu.h"

#include <Eigen/Geometry>

namespace locus::inertial {

/// Order of the fifteen errors: of each axis position, velocity and attitude (3 axis + 0, 1, 2), then the
/// accelerometer's bias and the gyroscope's.
inline constexpr int navigation_size = 15;
inline constexpr int accelerometer_bias_at = 9;
inline constexpr int gyroscope_bias_at = 12;

struct Motion {
    Eigen::Vector3d position_site_m;
    Eigen::Vector3d velocity_site_mps;
    Eigen::Quaterniond body_to_site;
};

/// Densities of white noise, and of the white noise that moves the biases.
struct ImuNoise {
    double acceleration_mps2_rthz = 0;
    double angular_rate_radps_rthz = 0;
    double acceleration_bias_walk_mps2_rts = 0;
    double angular_rate_bias_walk_radps_rts = 0;
};

/// `unbiased`: rates less biases, held for `dt_s`.
void move(Motion& motion, const Rates& unbiased, double dt_s) noexcept;

/// Makes good that the rates were held while they really ran straight to the next sample.
void catch_up(Motion& motion, const HeldImu::Lag& lag) noexcept;

/// What `dt_s` does to the errors, for the motion before the step.
using ErrorTransition = Eigen::Matrix<double, navigation_size, navigation_size>;
ErrorTransition error_transition(const Motion& motion, const Rates& unbiased, double dt_s) noexcept;

/// Variance that the errors gain in `dt_s`; diagonal but for position with velocity, which is given in the transition's
/// order.
ErrorTransition error_noise(const ImuNoise& noise, double dt_s) noexcept;

} // namespace locus::inertial
