#include "fusion/inertial/attitude.h"

#include "fusion/filter/scalar_update.h"
#include "fusion/geometry/rotation.h"
#include "fusion/units.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace locus::inertial {
namespace {

/// For which a turn lasts, so that an error of sensitivity counts once a turn, not once a sample.
constexpr double turn_time_s = 1;

/// A sample that stands for a longer time was followed by others that are lost, and the body may have turned unseen.
constexpr double longest_sample_s = 0.1;
constexpr double unseen_rate_radps = 1;

double square(double x) { return x * x; }

} // namespace

void Attitude::start(const Eigen::Vector3d& specific_force_mps2, double sigma_mps2) noexcept {
    worn_ = body_to_level_ = levelled(specific_force_mps2);
    bias_radps_.setZero();
    const double tilt = square(sigma_mps2 / standard_gravity_mps2), bias = square(settings_.gyro_bias_sigma_radps);
    covariance_ = (Vector6() << tilt, tilt, 0, bias, bias, bias).finished().asDiagonal();
}

void Attitude::turn(const Eigen::Vector3d& angular_rate_radps, double dt_s) noexcept {
    const Eigen::Vector3d rate = angular_rate_radps - bias_radps_;
    const Eigen::Matrix3d by_bias = -dt_s * body_to_level_.toRotationMatrix();
    body_to_level_ = (body_to_level_ * rotation(rate * dt_s)).normalized();

    Matrix6 transition = Matrix6::Identity();
    transition.topRightCorner<3, 3>() = by_bias;
    covariance_ = (transition * covariance_ * transition.transpose()).eval();
    const double density = square(settings_.gyro_noise_radps_rthz);
    const Eigen::Vector3d turning = (body_to_level_ * rate).cwiseAbs2() * square(settings_.gyro_scale_sigma);
    covariance_.diagonal().head<3>() += dt_s * (turning * turn_time_s + Eigen::Vector3d::Constant(density));
    const double unseen_s = std::max(0.0, dt_s - longest_sample_s);
    covariance_.diagonal().head<3>().array() += square(unseen_rate_radps * unseen_s);
    covariance_.diagonal().tail<3>().array() += dt_s * square(settings_.gyro_bias_walk_radps_rts);
    covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
}

/// With R = (I + [e]x) R^ the measured "up" in the level frame is (-e_y, e_x, 1): tilt shows, heading does not.
void Attitude::level(const Eigen::Vector3d& specific_force_mps2, double dt_s) noexcept {
    const double force = specific_force_mps2.norm();
    if (force < 0.1 * standard_gravity_mps2) return;
    const Eigen::Vector3d up = body_to_level_ * specific_force_mps2 / force;
    const double off_gravity = force - standard_gravity_mps2;
    const double repeated = std::max(1.0, settings_.force_time_s / std::max(dt_s, 1e-4));
    const double variance =
        (square(settings_.force_sigma_mps2) + square(off_gravity)) * repeated / square(standard_gravity_mps2);
    observe(0, up.y(), variance);
    observe(1, -(body_to_level_ * specific_force_mps2 / force).x(), variance); // after the first has turned it
}

void Attitude::rest(const Eigen::Vector3d& angular_rate_radps, double dt_s) noexcept {
    const double repeated = std::max(1.0, settings_.force_time_s / std::max(dt_s, 1e-4));
    for (int axis = 0; axis < 3; ++axis)
        observe(3 + axis, angular_rate_radps(axis) - bias_radps_(axis),
                square(settings_.rest_rate_sigma_radps) * repeated);
}

void Attitude::correct_heading(double error_rad, double sigma_rad) noexcept {
    observe(2, error_rad, square(sigma_rad));
}

double Attitude::heading_rad() const noexcept {
    const Eigen::Quaterniond turned = body_to_level_ * worn_.conjugate();
    return std::remainder(2 * std::atan2(turned.z(), turned.w()), 2 * std::numbers::pi);
}

void Attitude::observe(int state, double innovation, double variance) noexcept {
    const Vector6 jacobian = Vector6::Unit(state);
    const auto prediction = filter::predict_scalar(covariance_, jacobian);
    Vector6 error = Vector6::Zero();
    filter::update_scalar(error, covariance_, prediction, innovation, variance);
    apply(error);
}

void Attitude::apply(const Vector6& error) noexcept {
    body_to_level_ = (rotation(error.head<3>()) * body_to_level_).normalized();
    bias_radps_ += error.tail<3>();
}

} // namespace locus::inertial
