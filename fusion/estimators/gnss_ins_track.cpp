#include "fusion/estimators/gnss_ins_track.h"

#include "fusion/estimators/gnss_ins_errors.h"
#include "fusion/geometry/rotation.h"

#include <utility>

namespace locus {

GnssInsTrack::GnssInsTrack(GnssInsMotionModel model) noexcept
    : WanderingState(gnss_ins_core), model_(std::move(model)) {
    for (int i = 0; i < 3; ++i) {
        covariance(inertial::accelerometer_bias_at + i, inertial::accelerometer_bias_at + i) =
            own_square(model_.acceleration_bias_sigma_mps2);
        covariance(inertial::gyroscope_bias_at + i, inertial::gyroscope_bias_at + i) =
            own_square(model_.angular_rate_bias_sigma_radps);
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
    covariance(clock_offset_at, clock_offset_at) = own_square(start.clock_offset_sigma_m);
    covariance(clock_drift_at, clock_drift_at) = own_square(start.clock_drift_sigma_mps);
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
    const double drift = own_square(model_.clock_drift_mps_rts) * dt_s;
    covariance(clock_offset_at, clock_offset_at) +=
        own_square(model_.clock_phase_m_rts) * dt_s + drift * dt_s * dt_s / 3;
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

void GnssInsTrack::shift_clock(double jump_m, double sigma_m) noexcept {
    state(clock_offset_at) += jump_m;
    const double drift_variance = covariance(clock_drift_at, clock_drift_at);
    covariance.row(clock_offset_at).setZero();
    covariance.col(clock_offset_at).setZero();
    covariance(clock_offset_at, clock_offset_at) = own_square(sigma_m);
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
