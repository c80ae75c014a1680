// Motion of one axis between two measurements: position, velocity and an acceleration that dies away (Singer 1970).
// Paper 001 takes the acceleration as constant; then a gap of a second lets the velocity run away. With a decay time
// the acceleration is forgotten, and a decay time much longer than any gap gives the paper's model again.
#pragma once

#include <Eigen/Core>

namespace locus::filter {

struct MotionModel {
    double acceleration_sigma_mps2 = 2; ///< of the acceleration at any time
    double acceleration_time_s = 1;     ///< in which a manoeuvre dies away to 1/e
};

/// Transition and noise of (position, velocity, acceleration) of one axis over one step.
struct AxisStep {
    Eigen::Matrix3d transition;
    Eigen::Matrix3d noise;
};

/// For `dt_s` >= 0. The noise is always positive semi-definite.
AxisStep axis_step(const MotionModel& model, double dt_s) noexcept;

/// A scalar that wanders about zero with standard deviation `sigma` and forgets itself in `time_s` (Gauss-Markov):
/// what it keeps of its value over dt, and the variance it gains.
struct WanderStep {
    double keep;
    double variance;
};
WanderStep wander_step(double sigma, double time_s, double dt_s) noexcept;

} // namespace locus::filter
