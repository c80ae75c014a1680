#include "fusion/estimators/gnss_ins_track.h"

#include "fusion/geometry/earth.h"
#include "fusion/geometry/rotation.h"
#include "fusion/geometry/vector.h"

#include <cmath>
#include <utility>

namespace locus {
namespace {

/// A course known better than this makes a heading: the filter aligns from 20 degrees off.
constexpr double worst_course_sigma_rad = 0.2;

double variance_of(double x) { return x * x; }

} // namespace

GnssInsTrack::GnssInsTrack(GnssInsMotionModel model) noexcept
    : WanderingState(gnss_ins_core), model_(std::move(model)) {
    for (int i = 0; i < 3; ++i) {
        covariance(inertial::accelerometer_bias_at + i, inertial::accelerometer_bias_at + i) =
            variance_of(model_.acceleration_bias_sigma_mps2);
        covariance(inertial::gyroscope_bias_at + i, inertial::gyroscope_bias_at + i) =
            variance_of(model_.angular_rate_bias_sigma_radps);
    }
}

void GnssInsTrack::start(const GnssInsStart& start) noexcept {
    const Eigen::Matrix<double, 6, 1> biases = state.segment<6>(inertial::accelerometer_bias_at);
    const Eigen::Matrix<double, 6, 6> known =
        covariance.block<6, 6>(inertial::accelerometer_bias_at, inertial::accelerometer_bias_at);
    clear(gnss_ins_core);
    state.segment<6>(inertial::accelerometer_bias_at) = biases;
    covariance.block<6, 6>(inertial::accelerometer_bias_at, inertial::accelerometer_bias_at) = known;
    ask_for_scales();
    inertial_ = false;
    set_motion({start.position_ecef_m, start.velocity_ecef_mps, Eigen::Quaterniond::Identity()});
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            covariance(place(i, 0), place(j, 0)) = start.position_covariance_m2(i, j);
            covariance(place(i, 1), place(j, 1)) = start.velocity_covariance_m2ps2(i, j);
        }
    state(clock_offset_at) = start.clock_offset_m;
    state(clock_drift_at) = start.clock_drift_mps;
    covariance(clock_offset_at, clock_offset_at) = variance_of(start.clock_offset_sigma_m);
    covariance(clock_drift_at, clock_drift_at) = variance_of(start.clock_drift_sigma_mps);
}

// ---- motion

void GnssInsTrack::set_motion(const inertial::EcefMotion& motion) noexcept {
    for (int axis = 0; axis < 3; ++axis) {
        state(place(axis, 0)) = motion.position_ecef_m(axis);
        state(place(axis, 1)) = motion.velocity_ecef_mps(axis);
    }
    body_to_ecef_ = motion.body_to_ecef;
}

void GnssInsTrack::predict(double dt_s) noexcept {
    if (dt_s == 0) return;
    since_imu_s_ += dt_s;
    if (inertial_ && since_imu_s_ > inertial::HeldImu::max_gap_s) fall_back();
    inertial::EcefMotion now = motion();
    if (inertial_) {
        const inertial::Rates rates = unbiased();
        const inertial::ErrorTransition transition = inertial::error_transition(now, rates, dt_s);
        inertial::move(now, rates, dt_s);
        set_motion(now);
        put_scales_into_biases(rates, 1);
        move_core(transition, inertial::error_noise(model_.imu, dt_s), dt_s);
        put_scales_into_biases(rates, -1);
        return;
    }
    inertial::ErrorTransition transition = inertial::ErrorTransition::Identity();
    for (int axis = 0; axis < 3; ++axis) transition(place(axis, 0), place(axis, 1)) = dt_s;
    now.position_ecef_m += dt_s * now.velocity_ecef_mps;
    set_motion(now);
    inertial::ImuNoise noise = model_.imu;
    noise.acceleration_mps2_rthz = model_.unaided_acceleration_mps2_rthz;
    noise.angular_rate_radps_rthz = 0; // there is no attitude yet
    move_core(transition, inertial::error_noise(noise, dt_s), dt_s);
}

namespace {

constexpr int moving = inertial::accelerometer_bias_at; ///< position, velocity and attitude: what moves by itself

/// F x for the core's rows of x: biases and the drift of the clock stay, which is half of all the work.
// NOLINTBEGIN(cppcoreguidelines-missing-std-forward): columns are temporaries that stand for what they refer to
template <class Column>
void carry(const Eigen::Matrix<double, moving, inertial::navigation_size>& f, double dt_s, Column&& column) {
    const Eigen::Matrix<double, moving, 1> moved = f.lazyProduct(column.template head<inertial::navigation_size>());
    column.template head<moving>() = moved;
    column(clock_offset_at) += dt_s * column(clock_drift_at);
}
// NOLINTEND(cppcoreguidelines-missing-std-forward)

} // namespace

void GnssInsTrack::move_core(const inertial::ErrorTransition& transition, const inertial::ErrorTransition& noise,
                             double dt_s) noexcept {
    const Eigen::Matrix<double, moving, inertial::navigation_size> f = transition.topRows<moving>();
    state(clock_offset_at) += dt_s * state(clock_drift_at);
    Core core = covariance.topLeftCorner<gnss_ins_core, gnss_ins_core>();
    for (int k = 0; k < gnss_ins_core; ++k) carry(f, dt_s, core.col(k));
    core.transposeInPlace();
    for (int k = 0; k < gnss_ins_core; ++k) carry(f, dt_s, core.col(k));
    covariance.topLeftCorner<gnss_ins_core, gnss_ins_core>() = core;
    covariance.topLeftCorner<inertial::navigation_size, inertial::navigation_size>() += noise;
    // Groves eq. 9.151: the drift walks, and its integral with it.
    const double drift = variance_of(model_.clock_drift_mps_rts) * dt_s;
    covariance(clock_offset_at, clock_offset_at) +=
        variance_of(model_.clock_phase_m_rts) * dt_s + drift * dt_s * dt_s / 3;
    covariance(clock_offset_at, clock_drift_at) += drift * dt_s / 2;
    covariance(clock_drift_at, clock_drift_at) += drift;
    wander(
        [&](auto column, double keep) {
            Eigen::Matrix<double, gnss_ins_core, 1> now = column;
            carry(f, dt_s, now);
            column = keep * now;
        },
        dt_s);
}

// ---- attitude

void GnssInsTrack::sense(const ImuSample& sample, Timestamp time, bool started) noexcept {
    const inertial::Rates held = unbiased();
    const Eigen::Vector3d force = model_.sensor_to_body * vector(sample.specific_force_mps2);
    const Eigen::Vector3d rate = model_.sensor_to_body * vector(sample.angular_rate_radps);
    ImuSample turned = sample;
    turned.specific_force_mps2 = {force.x(), force.y(), force.z()};
    turned.angular_rate_radps = {rate.x(), rate.y(), rate.z()};
    const auto lag = imu_.take(turned, time);
    if (started) ask_for_scales();
    since_imu_s_ = 0;
    sensed_ = true;
    if (!lag) {
        levelling_.forget();
        rest_.forget();
        return;
    }
    rest_.carry(imu_.rates(), lag->held_s);
    if (inertial_) {
        inertial::EcefMotion now = motion();
        inertial::catch_up(now, held, *lag);
        set_motion(now);
        return;
    }
    levelling_.carry(unbiased(), lag->held_s);
    if (started && levelling_.is_level()) begin_inertial_if_fast();
}

/// A course on the level and how unsure it is: by the velocity across it.
GnssInsTrack::Course GnssInsTrack::course() const noexcept {
    const Eigen::Vector3d up = position_m().normalized();
    const Eigen::Vector3d level = velocity_ecef_mps() - up.dot(velocity_ecef_mps()) * up;
    const Eigen::Vector3d across = up.cross(level.normalized());
    double variance = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) variance += across(i) * covariance(place(i, 1), place(j, 1)) * across(j);
    return {level, std::sqrt(variance) / level.norm()};
}

void GnssInsTrack::begin_inertial_if_fast() noexcept {
    const Course now = course();
    if (now.velocity_ecef_mps.norm() < model_.align_speed_mps || now.sigma_rad > worst_course_sigma_rad) return;
    begin_inertial(now.velocity_ecef_mps, std::hypot(model_.align_heading_sigma_rad, now.sigma_rad));
}

void GnssInsTrack::begin_inertial(const Eigen::Vector3d& course_ecef, double heading_sigma_rad) noexcept {
    const Eigen::Vector3d course = enu_to_ecef(geodetic(position_m())).transpose() * course_ecef;
    begin_inertial(std::atan2(course.y(), course.x()), course.norm(), heading_sigma_rad);
}

bool GnssInsTrack::begin_inertial_towards(double forward_from_east_rad, double heading_sigma_rad) noexcept {
    if (!sensed_ || !levelling_.is_level()) return false;
    begin_inertial(forward_from_east_rad, velocity_ecef_mps().norm(), heading_sigma_rad);
    return true;
}

void GnssInsTrack::begin_inertial(double forward_from_east_rad, double speed_mps, double heading_sigma_rad) noexcept {
    const Eigen::Matrix3d enu = enu_to_ecef(geodetic(position_m()));
    const double turn = forward_from_east_rad - heading_rad(levelling_.body_to_level());
    const Eigen::Quaterniond heading(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()));
    body_to_ecef_ = (Eigen::Quaterniond(enu) * heading * levelling_.body_to_level()).normalized();
    const double tilt = levelling_.tilt_sigma_rad(speed_mps, model_.acceleration_bias_sigma_mps2);
    const Eigen::Vector3d variances(variance_of(tilt), variance_of(tilt), variance_of(heading_sigma_rad));
    const Eigen::Matrix3d attitude = enu * variances.asDiagonal() * enu.transpose();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j)
            covariance(place(i, 2), place(j, 2)) = covariance(place(j, 2), place(i, 2)) = attitude(i, j);
    const Eigen::Vector3d lever = body_to_ecef_ * model_.antenna_body_m;
    for (int axis = 0; axis < 3; ++axis) state(place(axis, 0)) -= lever(axis);
    inertial_ = true;
}

void GnssInsTrack::fall_back() noexcept {
    const Eigen::Vector3d antenna_m = point_ecef_m(model_.antenna_body_m);
    for (int axis = 0; axis < 3; ++axis) {
        state(place(axis, 0)) = antenna_m(axis);
        covariance.row(place(axis, 2)).setZero();
        covariance.col(place(axis, 2)).setZero();
    }
    inertial_ = false;
    levelling_.forget();
    rest_.forget();
}

void GnssInsTrack::shift_clock(double jump_m, double sigma_m) noexcept {
    state(clock_offset_at) += jump_m;
    const double drift_variance = covariance(clock_drift_at, clock_drift_at);
    covariance.row(clock_offset_at).setZero();
    covariance.col(clock_offset_at).setZero();
    covariance(clock_offset_at, clock_offset_at) = variance_of(sigma_m);
    covariance(clock_drift_at, clock_drift_at) = drift_variance;
}

// ---- corrections

void GnssInsTrack::correct(const filter::Prediction<Vector>& prediction, double innovation, double variance,
                           const filter::Share& share) noexcept {
    filter::update_scalar(state, covariance, prediction, innovation, variance, share);
    move_by(Vector::Zero(size()));
}

void GnssInsTrack::move_by(const Vector& error) noexcept {
    state += error;
    const Eigen::Vector3d turn(state(place(0, 2)), state(place(1, 2)), state(place(2, 2)));
    if (inertial_) body_to_ecef_ = (rotation(turn) * body_to_ecef_).normalized();
    for (int axis = 0; axis < 3; ++axis) state(place(axis, 2)) = 0;
}

} // namespace locus
