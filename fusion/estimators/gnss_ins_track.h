// How a vehicle moves, in ECEF: position, velocity, attitude and the biases of its inertial sensor, and the receiver's
// clock (paper 002's 17 states, Groves 2013 section 14.2.4); behind them whatever constant or wandering error its other
// sources have. Without an aligned inertial sensor the velocity walks at random, in the same states: with the first
// seconds at speed the course gives the heading, and the filter aligns the rest.
#pragma once

#include "fusion/filter/scalar_update.h"
#include "fusion/filter/wandering_state.h"
#include "fusion/inertial/ecef_strapdown.h"
#include "fusion/inertial/levelling.h"
#include "fusion/inertial/rest.h"

namespace locus {

inline constexpr int clock_offset_at = inertial::navigation_size, clock_drift_at = clock_offset_at + 1;
inline constexpr int gnss_ins_core = clock_drift_at + 1;

struct GnssInsMotionModel {
    inertial::ImuNoise imu;
    double acceleration_bias_sigma_mps2 = 0;
    double angular_rate_bias_sigma_radps = 0;
    double scale_sigma = 0; ///< of each axis of both sensors; 0: the scales are right
    double unaided_acceleration_mps2_rthz = 0;
    double clock_phase_m_rts = 0;
    double clock_drift_mps_rts = 0;
    double align_speed_mps = 0;
    double align_heading_sigma_rad = 0;
    Eigen::Quaterniond sensor_to_body = Eigen::Quaterniond::Identity();
    Eigen::Vector3d antenna_body_m{0, 0, 0}; ///< what the state is the position of while the body is a point
};

/// Where a track begins; sigmas of position and velocity as covariances in ECEF.
struct GnssInsStart {
    Eigen::Vector3d position_ecef_m{0, 0, 0};
    Eigen::Vector3d velocity_ecef_mps{0, 0, 0};
    Eigen::Matrix3d position_covariance_m2 = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d velocity_covariance_m2ps2 = Eigen::Matrix3d::Zero();
    double clock_offset_m = 0, clock_offset_sigma_m = 0;
    double clock_drift_mps = 0, clock_drift_sigma_mps = 0;
};

class GnssInsTrack : public filter::WanderingState<gnss_ins_core, 40> {
  public:
    explicit GnssInsTrack(GnssInsMotionModel model) noexcept;

    /// Not inertial yet; all wanderers are forgotten, what the sensor taught at rest stays.
    void start(const GnssInsStart& start) noexcept;
    /// `dt_s` >= 0.
    void predict(double dt_s) noexcept;
    /// The state is at `time`. Before start() it only levels.
    void sense(const ImuSample& sample, Timestamp time, bool started) noexcept;
    void correct(const filter::Prediction<Vector>& prediction, double innovation, double variance,
                 const filter::Share& share) noexcept;
    /// Adds an error as the jacobians mean it: the third numbers turn the attitude.
    void move_by(const Vector& error) noexcept;
    /// Makes the attitude known at once: the forward axis along `course_ecef`, tilt as levelled.
    void begin_inertial(const Eigen::Vector3d& course_ecef, double heading_sigma_rad) noexcept;
    /// The same with the forward axis that way on the level, counter-clockwise from east, if which way is down is
    /// known.
    bool begin_inertial_towards(double forward_from_east_rad, double heading_sigma_rad) noexcept;
    /// Keeps the place of a point and the clock as states of their own, for what is observed of both now and later.
    void hold_place(const Eigen::Vector3d& lever_body_m) noexcept;
    /// Where x, y, z and clock then stand in the state; the first is -1 when nothing is held.
    std::array<int, 4> held_place() const noexcept;
    /// A receiver set its clock: by `jump_m`, not surer than `sigma_m`.
    void shift_clock(double jump_m, double sigma_m) noexcept;

    /// Where the errors of the accelerometer's three scales stand, and behind them those of the gyroscope's; -1: they
    /// are taken to be right.
    int scales_at() const noexcept { return model_.scale_sigma > 0 && size() >= first_scale + 6 ? first_scale : -1; }

    bool is_inertial() const noexcept { return inertial_; }
    bool is_at_rest() const noexcept { return sensed_ && rest_.is_at_rest(); }
    Eigen::Vector3d velocity_ecef_mps() const noexcept { return {state(1), state(4), state(7)}; }
    const Eigen::Quaterniond& body_to_ecef() const noexcept { return body_to_ecef_; }
    const Eigen::Vector3d& measured_rate_radps() const noexcept { return imu_.rates().angular_rate_radps; }
    /// Less the bias; zero without a sensor.
    Eigen::Vector3d angular_rate_radps() const noexcept { return inertial_ ? unbiased().angular_rate_radps : zero(); }

    /// Of a point of the body; without attitude the body is a point.
    Eigen::Vector3d point_ecef_m(const Eigen::Vector3d& lever_body_m) const noexcept;
    Eigen::Vector3d point_velocity_ecef_mps(const Eigen::Vector3d& lever_body_m) const noexcept;
    /// From the gradient of an observation by the point's position or velocity to its gradient by the state: adds it.
    void spread_position(const Eigen::Vector3d& gradient, const Eigen::Vector3d& lever_body_m,
                         Vector& jacobian) const noexcept;
    void spread_velocity(const Eigen::Vector3d& gradient, const Eigen::Vector3d& lever_body_m,
                         Vector& jacobian) const noexcept;

  private:
    using Core = Eigen::Matrix<double, gnss_ins_core, gnss_ins_core>;
    static constexpr int first_scale = gnss_ins_core; ///< the first wanderers of all
    static Eigen::Vector3d zero() noexcept { return Eigen::Vector3d::Zero(); }
    inertial::Rates unbiased() const noexcept;
    void ask_for_scales() noexcept;
    void put_scales_into_biases(const inertial::Rates& at, double sign) noexcept;
    inertial::EcefMotion motion() const noexcept { return {position_m(), velocity_ecef_mps(), body_to_ecef_}; }
    void set_motion(const inertial::EcefMotion& motion) noexcept;
    void move_core(const inertial::ErrorTransition& transition, const inertial::ErrorTransition& noise,
                   double dt_s) noexcept;
    struct Course {
        Eigen::Vector3d velocity_ecef_mps;
        double sigma_rad;
    };
    Course course() const noexcept;
    void begin_inertial_if_fast() noexcept;
    void begin_inertial(double forward_from_east_rad, double speed_mps, double heading_sigma_rad) noexcept;
    void fall_back() noexcept;
    Eigen::Vector3d lever_velocity_ecef_mps(const Eigen::Vector3d& lever_body_m) const noexcept;

    GnssInsMotionModel model_;
    inertial::HeldImu imu_;
    inertial::Levelling levelling_;
    inertial::Rest rest_;
    bool inertial_ = false;
    bool sensed_ = false;
    double since_imu_s_ = 0;
    Eigen::Quaterniond body_to_ecef_ = Eigen::Quaterniond::Identity();
};

} // namespace locus
