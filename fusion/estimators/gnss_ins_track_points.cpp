// Where the points of the vehicle are that observations are made at (antenna, tag, axle), and how they hang on the
// state.
#include "fusion/estimators/gnss_ins_errors.h"
#include "fusion/estimators/gnss_ins_track.h"
#include "fusion/option.h"

#include <algorithm>
#include <array>

namespace locus {

Eigen::Vector3d GnssInsTrack::point_ecef_m(const Eigen::Vector3d& lever_body_m) const noexcept {
    return inertial_ ? Eigen::Vector3d(position_m() + body_to_ecef_ * lever_body_m) : position_m();
}

Eigen::Vector3d GnssInsTrack::lever_velocity_ecef_mps(const Eigen::Vector3d& lever_body_m) const noexcept {
    return body_to_ecef_ * angular_rate_radps().cross(lever_body_m);
}

// The sensor turns against the stars, the lever's velocity is against the Earth: 0.07 mm/s for a lever of a metre.
Eigen::Vector3d GnssInsTrack::point_velocity_ecef_mps(const Eigen::Vector3d& lever_body_m) const noexcept {
    return velocity_ecef_mps() + lever_velocity_ecef_mps(lever_body_m);
}

void GnssInsTrack::spread_position(const Eigen::Vector3d& gradient, const Eigen::Vector3d& lever_body_m,
                                   Vector& jacobian) const noexcept {
    const Eigen::Vector3d by_attitude = (body_to_ecef_ * lever_body_m).cross(gradient);
    for (int axis = 0; axis < 3; ++axis) {
        jacobian(place(axis, 0)) += gradient(axis);
        if (inertial_) jacobian(place(axis, 2)) += by_attitude(axis);
    }
}

void GnssInsTrack::spread_velocity(const Eigen::Vector3d& gradient, const Eigen::Vector3d& lever_body_m,
                                   Vector& jacobian) const noexcept {
    const Eigen::Vector3d by_attitude = lever_velocity_ecef_mps(lever_body_m).cross(gradient);
    const Eigen::Vector3d by_bias = (body_to_ecef_.conjugate() * gradient).cross(lever_body_m);
    for (int axis = 0; axis < 3; ++axis) {
        jacobian(place(axis, 1)) += gradient(axis);
        if (!inertial_) continue;
        jacobian(place(axis, 2)) += by_attitude(axis);
        jacobian(inertial::gyroscope_bias_at + axis) += by_bias(axis);
    }
}

// ---- a place that is held

void GnssInsTrack::hold_place(const Eigen::Vector3d& lever_body_m) noexcept {
    const filter::WanderModel stays{0, no_limit};
    const Eigen::Vector3d place_m = point_ecef_m(lever_body_m);
    std::array<int, 4> at{};
    for (int i = 0; i < 4; ++i) at[static_cast<std::size_t>(i)] = wanderer(held_place_state - i, stays);
    for (int axis = 0; axis < 3; ++axis) {
        Vector jacobian = Vector::Zero(size());
        spread_position(Eigen::Vector3d::Unit(axis), lever_body_m, jacobian);
        become_copy(at[static_cast<std::size_t>(axis)], place_m(axis), jacobian);
    }
    become_copy(at[3], state(clock_offset_at), Vector::Unit(size(), clock_offset_at));
}

std::array<int, 4> GnssInsTrack::held_place() const noexcept {
    std::array<int, 4> at{};
    for (int i = 0; i < 4; ++i) at[static_cast<std::size_t>(i)] = known_wanderer(held_place_state - i);
    if (std::ranges::min(at) < 0) at[0] = -1;
    return at;
}

} // namespace locus
