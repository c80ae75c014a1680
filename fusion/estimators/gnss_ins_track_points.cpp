// Where the points of the vehicle are that observations are made at (antenna, tag, axle), and how they hang on the
// state.
#include "fusion/estimators/gnss_ins_track.h"

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

} // namespace locus
