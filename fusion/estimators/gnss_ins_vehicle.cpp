// What the vehicle itself says, and the anchors indoors: its inertial sensor, its wheels, its barometer, UWB ranges.
#include "fusion/estimators/gnss_ins.h"

#include <cmath>

namespace locus {
namespace {

/// The vehicle's own constraints are no news more often than this.
constexpr Duration constraint_period = std::chrono::milliseconds{100};
constexpr double wheel_memory_s = 0.5;
constexpr double standing_speed_mps = 0.1;
/// A sensor that lies still at this speed rides on a smooth road.
constexpr double most_speed_at_rest_mps = 1;
constexpr double most_pressure_age_s = 2;
constexpr double range_memory = 200; ///< observations over which the share of refused ones is taken

} // namespace

bool GnssIns::is_due(Timestamp& last, Timestamp time) noexcept {
    if (time - last < constraint_period) return false;
    last = time;
    return true;
}

Verdict GnssIns::take(const ImuSample& sample, Timestamp time) noexcept {
    if (!settings().use_imu) return {Exclusion::disabled};
    move_to(time);
    track_.sense(sample, time, started_);
    if (!started_) return {};
    const bool still = settings().zero_velocity && track_.is_at_rest() && stands_by_wheel(time) &&
                       track_.velocity_ecef_mps().norm() < most_speed_at_rest_mps;
    if (still && is_due(stood_, time)) stand();
    if (!still && track_.is_inertial() && settings().non_holonomic && is_due(held_to_road_, time)) hold_to_the_road();
    return {};
}

bool GnssIns::stands_by_wheel(Timestamp time) const noexcept {
    return to_s(time - wheel_heard_) > wheel_memory_s || std::abs(wheel_mps_) < standing_speed_mps;
}

void GnssIns::stand() noexcept {
    for (int axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<std::size_t>(axis);
        weigh(Aid::standing, observations_->standing(track_, axis),
              gates_[static_cast<std::size_t>(Aid::standing)][at]);
        weigh(Aid::standing_rate, observations_->standing_rate(track_, axis),
              gates_[static_cast<std::size_t>(Aid::standing_rate)][at]);
    }
}

void GnssIns::hold_to_the_road() noexcept {
    for (const int axis : {1, 2})
        weigh(Aid::slip, observations_->slip(track_, axis),
              gates_[static_cast<std::size_t>(Aid::slip)][static_cast<std::size_t>(axis)]);
}

Verdict GnssIns::take(const WheelSpeed& wheel, Timestamp time) noexcept {
    if (!settings().use_wheel_speed) return {Exclusion::disabled};
    wheel_mps_ = wheel.speed_mps;
    wheel_heard_ = time;
    if (!started_ || !track_.is_inertial()) return {Exclusion::waiting_for_start};
    if (!is_due(wheel_used_, time)) return {};
    move_to(time);
    if (std::isfinite(wheel.yaw_rate_radps))
        weigh(Aid::yaw, observations_->yaw_rate(track_, wheel), gates_[static_cast<std::size_t>(Aid::yaw)][0]);
    return weigh(Aid::wheel, observations_->wheel_speed(track_, wheel),
                 gates_[static_cast<std::size_t>(Aid::wheel)][0]);
}

Verdict GnssIns::take(const Pressure& pressure, Timestamp time) noexcept {
    if (!settings().use_pressure) return {Exclusion::disabled};
    pressure_ = pressure;
    if (!started_) return {Exclusion::waiting_for_start};
    if (!is_due(pressure_heard_, time)) return {};
    move_to(time);
    return weigh(Aid::pressure, observations_->pressure(track_, pressure),
                 gates_[static_cast<std::size_t>(Aid::pressure)][0]);
}

bool GnssIns::height_is_off(const GnssFix& fix) noexcept {
    if (settings().refuse_fix_height_m <= 0 || to_s(time_ - pressure_heard_) > most_pressure_age_s) return false;
    const auto height_m = observations_->height_by_pressure_m(track_, pressure_);
    return height_m && std::abs(fix.height_ellipsoid_m - *height_m) > settings().refuse_fix_height_m;
}

Verdict GnssIns::take(const Range& range, Timestamp time) noexcept {
    const Anchor* anchor = site_->find_anchor(range.anchor);
    if (anchor == nullptr) return {Exclusion::unknown_source};
    if (!started_) return {Exclusion::waiting_for_start};
    move_to(time);
    const auto at = static_cast<std::size_t>(anchor - site_->anchors.data());
    const Verdict verdict =
        weigh(Aid::range, observations_->range(track_, range, *anchor), anchor_gates_[at % anchor_gates_.size()]);
    note(verdict, time, range_memory);
    return verdict;
}

} // namespace locus
