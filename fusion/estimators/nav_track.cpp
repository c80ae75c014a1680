#include "fusion/estimators/nav_track.h"

#include "fusion/geometry/rotation.h"
#include "fusion/units.h"

#include <cmath>
#include <utility>

namespace locus {
namespace {

/// A heading known better than this is a small error.
constexpr double aligned_sigma_rad = 0.2;
/// Length of (cos, sin): far from 1, the sensor does not move with the tag.
constexpr double least_length = 0.6, most_length = 1.6;

double square(double x) { return x * x; }

} // namespace

NavTrack::NavTrack(NavModel model) noexcept : KinematicState(model.kinematic), model_(std::move(model)) {}

void NavTrack::start(const Eigen::Vector3d& antenna_site_m, const Eigen::Matrix3d& covariance_m2) noexcept {
    mode_ = Mode::kinematic;
    start_motion(antenna_site_m, covariance_m2);
}

void NavTrack::predict(double dt_s) noexcept {
    if (dt_s == 0) return;
    since_imu_s_ += dt_s;
    if (mode_ != Mode::kinematic && since_imu_s_ > inertial::HeldImu::max_gap_s) fall_back();
    switch (mode_) {
    case Mode::kinematic:
        return predict_motion(dt_s);
    case Mode::aligning:
        return predict_aligning(dt_s);
    case Mode::inertial:
        return predict_inertial(dt_s);
    }
}

void NavTrack::sense(const ImuSample& sample, Timestamp time, bool started) noexcept {
    const auto lag = imu_.take(sample, time);
    since_imu_s_ = 0;
    if (!lag) levelling_.forget();
    if (mode_ == Mode::inertial && lag) {
        inertial::Motion now = motion();
        inertial::catch_up(now, *lag);
        set_motion(now);
    }
    if (lag) rest_.carry(imu_.rates(), lag->held_s);
    if (model_.foot_mounted) step(lag ? lag->held_s : inertial::HeldImu::max_gap_s);
    if (mode_ != Mode::inertial && lag) level(lag->held_s);
    if (!started) return;
    if (mode_ == Mode::kinematic && levelling_.is_level()) begin_aligning();
    if (mode_ != Mode::aligning) return;
    if (const auto known = heading()) begin_inertial(*known);
}

void NavTrack::step(double dt_s) noexcept {
    const Eigen::Vector3d bias = rest_.gyroscope_bias_radps().value_or(Eigen::Vector3d::Zero());
    stands_ = stance_.hear(imu_.rates().specific_force_mps2, imu_.rates().angular_rate_radps - bias, dt_s);
}

void NavTrack::keep_sensor(const NavTrack& other) noexcept {
    if (mode_ != Mode::kinematic) fall_back();
    imu_ = other.imu_;
    since_imu_s_ = other.since_imu_s_;
    levelling_ = other.levelling_;
    rest_ = other.rest_;
    stance_ = other.stance_;
    stands_ = other.stands_;
    if (other.mode_ == Mode::inertial) levelling_.continue_from(other.body_to_site_);
}

// ---- kinematic

/// Position and velocity go on as they are.
void NavTrack::change_mode(Mode mode, const CoreMap& map) noexcept {
    const Eigen::Matrix<double, motion_size, 1> before = state.head<motion_size>();
    change_core(map);
    for (int axis = 0; axis < 3; ++axis) state.segment<2>(place(axis, 0)) = before.segment<2>(place(axis, 0));
    mode_ = mode;
}

void NavTrack::fall_back() noexcept {
    const Eigen::Vector3d antenna_m = antenna_site_m();
    for (int axis = 0; axis < 3; ++axis) state(place(axis, 0)) = antenna_m(axis);
    change_mode(Mode::kinematic, way(motion_size, core()));
    for (int axis = 0; axis < 3; ++axis)
        covariance(place(axis, 2), place(axis, 2)) = square(model_.kinematic.motion.acceleration_sigma_mps2);
    levelling_.forget();
}

void NavTrack::level(double dt_s) noexcept {
    inertial::Rates rates = imu_.rates();
    rates.angular_rate_radps -= rest_.gyroscope_bias_radps().value_or(Eigen::Vector3d::Zero());
    levelling_.carry(rates, dt_s);
}

// ---- aligning: the third numbers are cos and sin of the heading of the level frame, and the accelerometer's error
// upwards

void NavTrack::begin_aligning() noexcept {
    change_mode(Mode::aligning, way(motion_size, motion_size));
    covariance(place(0, 2), place(0, 2)) = covariance(place(1, 2), place(1, 2)) = 0.5; // of a point on the circle
    covariance(place(2, 2), place(2, 2)) = square(model_.acceleration_bias_sigma_mps2);
}

void NavTrack::predict_aligning(double dt_s) noexcept {
    const Eigen::Vector3d level = levelling_.body_to_level() * imu_.rates().specific_force_mps2;
    const double c = state(place(0, 2)), s = state(place(1, 2)), up = state(place(2, 2));
    const Eigen::Vector3d acceleration(c * level.x() - s * level.y(), s * level.x() + c * level.y(),
                                       level.z() - standard_gravity_mps2 + up);
    Eigen::Matrix<double, motion_size, motion_size> f = decltype(f)::Identity(), q = decltype(q)::Zero();
    const Eigen::Matrix3d by_third =
        (Eigen::Matrix3d() << level.x(), -level.y(), 0, level.y(), level.x(), 0, 0, 0, 1).finished();
    const double noise = square(model_.aligning_noise_mps2_rthz) * dt_s;
    for (int i = 0; i < 3; ++i) {
        state(place(i, 0)) += dt_s * (state(place(i, 1)) + 0.5 * dt_s * acceleration(i));
        state(place(i, 1)) += dt_s * acceleration(i);
        f(place(i, 0), place(i, 1)) = dt_s;
        for (int j = 0; j < 3; ++j) {
            f(place(i, 0), place(j, 2)) = 0.5 * dt_s * dt_s * by_third(i, j);
            f(place(i, 1), place(j, 2)) = dt_s * by_third(i, j);
        }
        q(place(i, 0), place(i, 0)) = noise * dt_s * dt_s / 3;
        q(place(i, 0), place(i, 1)) = q(place(i, 1), place(i, 0)) = noise * dt_s / 2;
        q(place(i, 1), place(i, 1)) = noise;
    }
    // The level frame turns with what is left of the gyroscope's bias; who looks for a heading looks for about 10 s.
    const double turning = square(model_.angular_rate_bias_sigma_radps) * 10 * dt_s;
    q(place(0, 2), place(0, 2)) = q(place(1, 2), place(1, 2)) = turning;
    move_core(f, q, dt_s);
}

/// Where it is known well enough to be a small error from now on.
std::optional<NavTrack::Heading> NavTrack::heading() const noexcept {
    const double c = state(place(0, 2)), s = state(place(1, 2));
    const double length = std::hypot(c, s);
    if (length < least_length || length > most_length) return {};
    const Eigen::Vector2d by_third(-s / square(length), c / square(length));
    Eigen::Matrix2d p;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) p(i, j) = covariance(place(i, 2), place(j, 2));
    if (by_third.dot(p * by_third) > square(aligned_sigma_rad)) return {};
    return Heading{std::atan2(s, c), by_third};
}

void NavTrack::begin_inertial(const Heading& heading) noexcept {
    CoreMap map = way(inertial::navigation_size, motion_size);
    map(place(2, 2), place(0, 2)) = heading.by_third(0);
    map(place(2, 2), place(1, 2)) = heading.by_third(1);
    change_mode(Mode::inertial, map);
    doubt_sensor();
    state.segment<3>(inertial::gyroscope_bias_at) = rest_.gyroscope_bias_radps().value_or(Eigen::Vector3d::Zero());
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(heading.angle_rad, Eigen::Vector3d::UnitZ()));
    body_to_site_ = turn * levelling_.body_to_level();
    const Eigen::Vector3d lever = lever_site_m();
    for (int axis = 0; axis < 3; ++axis) state(place(axis, 0)) -= lever(axis);
}

/// Tilt and biases begin as unsure as levelling and the settings say.
void NavTrack::doubt_sensor() noexcept {
    const double tilt =
        levelling_.tilt_sigma_rad(model_.kinematic.start_speed_sigma_mps, model_.acceleration_bias_sigma_mps2);
    covariance(place(0, 2), place(0, 2)) = covariance(place(1, 2), place(1, 2)) = square(tilt);
    for (int i = 0; i < 3; ++i) {
        covariance(inertial::accelerometer_bias_at + i, inertial::accelerometer_bias_at + i) =
            square(model_.acceleration_bias_sigma_mps2);
        covariance(inertial::gyroscope_bias_at + i, inertial::gyroscope_bias_at + i) =
            square(model_.angular_rate_bias_sigma_radps);
    }
}

// ---- inertial

inertial::Rates NavTrack::unbiased() const noexcept {
    return {imu_.rates().specific_force_mps2 - state.segment<3>(inertial::accelerometer_bias_at),
            imu_.rates().angular_rate_radps - state.segment<3>(inertial::gyroscope_bias_at)};
}

inertial::Motion NavTrack::motion() const noexcept { return {position_m(), velocity_mps(), body_to_site_}; }

void NavTrack::set_motion(const inertial::Motion& motion) noexcept {
    for (int axis = 0; axis < 3; ++axis) {
        state(place(axis, 0)) = motion.position_site_m(axis);
        state(place(axis, 1)) = motion.velocity_site_mps(axis);
    }
    body_to_site_ = motion.body_to_site;
}

void NavTrack::predict_inertial(double dt_s) noexcept {
    inertial::Motion now = motion();
    const inertial::Rates rates = unbiased();
    const inertial::ErrorTransition f = inertial::error_transition(now, rates, dt_s);
    inertial::move(now, rates, dt_s);
    set_motion(now);
    move_core(f, inertial::error_noise(model_.imu, dt_s), dt_s);
}

template <class Transition>
void NavTrack::move_core(const Transition& transition, const Transition& noise, double dt_s) noexcept {
    constexpr int n = Transition::RowsAtCompileTime;
    const Transition before = covariance.topLeftCorner<n, n>();
    const Transition half = transition * before;
    covariance.topLeftCorner<n, n>().noalias() = half * transition.transpose();
    covariance.topLeftCorner<n, n>() += noise;
    wander(
        [&](auto column, double keep) {
            const Eigen::Matrix<double, n, 1> now = column;
            column = keep * (transition * now);
        },
        dt_s);
}

Eigen::Vector3d NavTrack::lever_site_m() const noexcept {
    return mode_ == Mode::inertial ? body_to_site_ * model_.antenna_body_m : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

Eigen::Vector3d NavTrack::antenna_site_m() const noexcept { return position_m() + lever_site_m(); }

void NavTrack::spread_gradient(const Eigen::Vector3d& gradient, Vector& jacobian) const noexcept {
    const Eigen::Vector3d by_attitude = lever_site_m().cross(gradient);
    for (int axis = 0; axis < 3; ++axis) {
        jacobian(place(axis, 0)) = gradient(axis);
        if (mode_ == Mode::inertial) jacobian(place(axis, 2)) = by_attitude(axis);
    }
}

void NavTrack::correct(const filter::Prediction<Vector>& prediction, double innovation, double variance,
                       const filter::Share& share) noexcept {
    filter::update_scalar(state, covariance, prediction, innovation, variance, share);
    if (mode_ != Mode::inertial) return;
    const Eigen::Vector3d turn(state(place(0, 2)), state(place(1, 2)), state(place(2, 2)));
    body_to_site_ = (rotation(turn) * body_to_site_).normalized();
    for (int axis = 0; axis < 3; ++axis) state(place(axis, 2)) = 0;
}

void NavTrack::report(Estimate& estimate) const noexcept {
    report_motion(estimate);
    const Eigen::Vector3d antenna_m = antenna_site_m();
    for (int axis = 0; axis < 3; ++axis) estimate.position_site_m[axis] = antenna_m(axis);
    if (mode_ == Mode::inertial)
        estimate.orientation_xyzw = {body_to_site_.x(), body_to_site_.y(), body_to_site_.z(), body_to_site_.w()};
}

} // namespace locus
