// Attitude of a worn device: which way is down, and how far it has turned since the start. An error-state filter with
// six states (rotation error in the level frame, gyroscope bias in the body frame). Down comes from the accelerometer,
// believed the less the further its reading is from gravity; the heading comes from the gyroscope alone unless a
// compass is trusted, and its variance grows as the gyroscope's data sheet says.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace locus::inertial {

/// Defaults from data sheets of gyroscopes in phones and tags (Bosch BMI160: 0.007 deg/s per root Hz, zero-rate offset
/// 3 deg/s before calibration; TDK ICM-20948: 0.015 deg/s per root Hz, sensitivity 1.5 %).
struct AttitudeSettings {
    double gyro_noise_radps_rthz = 2.6e-4;  ///< 0.015 deg/s per root Hz
    double gyro_bias_sigma_radps = 0.01;    ///< at the start; 0.6 deg/s: after the device's own calibration
    double gyro_bias_walk_radps_rts = 2e-5; ///< of the bias in a second: temperature
    double gyro_scale_sigma = 0.015;        ///< error of the sensitivity
    double force_sigma_mps2 = 0.5;          ///< horizontal acceleration when |f| is g, as of a person
    double force_time_s = 0.3;              ///< for which an acceleration lasts: half a step
    double rest_rate_sigma_radps = 0.01;    ///< angular rate of a body that stands still
};

class Attitude {
  public:
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    using Matrix6 = Eigen::Matrix<double, 6, 6>;

    explicit Attitude(const AttitudeSettings& settings) : settings_(settings) {}

    /// Upright by a specific force, m/s^2, of a body that is hardly accelerated. Heading and its variance become zero.
    void start(const Eigen::Vector3d& specific_force_mps2, double sigma_mps2) noexcept;

    /// Turns by a gyroscope reading that held for `dt_s` > 0 (Sola 2017, eq. 260-270, with the error in the level
    /// frame).
    void turn(const Eigen::Vector3d& angular_rate_radps, double dt_s) noexcept;

    /// Takes in which way is up; `dt_s` is the time since the last such reading, for they are not independent.
    void level(const Eigen::Vector3d& specific_force_mps2, double dt_s) noexcept;

    /// The body does not turn: the gyroscope shows its bias (zero-angular-rate update, Skog et al. 2010).
    void rest(const Eigen::Vector3d& angular_rate_radps, double dt_s) noexcept;

    /// The heading is `error_rad` more than it is taken for, says a source of standard deviation `sigma_rad`.
    void correct_heading(double error_rad, double sigma_rad) noexcept;

    const Eigen::Quaterniond& body_to_level() const noexcept { return body_to_level_; }
    const Eigen::Vector3d& gyro_bias_radps() const noexcept { return bias_radps_; }

    /// Turn about the vertical since the start, -pi..pi, whichever way up the body is worn.
    double heading_rad() const noexcept;
    double heading_variance_rad2() const noexcept { return covariance_(2, 2); }
    const Matrix6& covariance() const noexcept { return covariance_; }

  private:
    void observe(int state, double innovation, double variance) noexcept;
    void apply(const Vector6& error) noexcept;

    AttitudeSettings settings_;
    Eigen::Quaterniond body_to_level_ = Eigen::Quaterniond::Identity();
    Eigen::Quaterniond worn_ = Eigen::Quaterniond::Identity(); ///< body_to_level_ at the start
    Eigen::Vector3d bias_radps_ = Eigen::Vector3d::Zero();
    Matrix6 covariance_ = Matrix6::Zero();
};

} // namespace locus::inertial
