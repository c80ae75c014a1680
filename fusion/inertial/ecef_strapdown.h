// Strapdown mechanisation in the Earth-fixed frame (Groves 2013, section 5.3): the Earth turns under the sensor and
// gravity follows the place, which a vehicle that crosses a city with a tactical sensor can tell. Errors are as in
// strapdown.h, in ECEF: true body_to_ecef = rotation(error) * body_to_ecef.
#pragma once

#include "fusion/inertial/strapdown.h"

namespace locus::inertial {

struct EcefMotion {
    Eigen::Vector3d position_ecef_m{0, 0, 0};
    Eigen::Vector3d velocity_ecef_mps{0, 0, 0};
    Eigen::Quaterniond body_to_ecef = Eigen::Quaterniond::Identity();
};

/// `unbiased`: rates less biases, held for `dt_s`.
void move(EcefMotion& motion, const Rates& unbiased, double dt_s) noexcept;

/// Makes good that `held` (less biases) was held while the rates really ran straight to the next sample: the half step
/// by which holding lags, and to the second order what the turning does to it, which is coning and sculling of two
/// samples (Savage 1998, parts 1 and 2).
void catch_up(EcefMotion& motion, const Rates& held, const HeldImu::Lag& lag) noexcept;

/// What `dt_s` does to the errors, for the motion before the step; rows as in strapdown.h.
ErrorTransition error_transition(const EcefMotion& motion, const Rates& unbiased, double dt_s) noexcept;

/// How gravity as it is felt changes with the place, 1/s^2; of a round Earth, which is within a hundredth.
Eigen::Matrix3d gravity_gradient(const Eigen::Vector3d& position_ecef_m) noexcept;

} // namespace locus::inertial
