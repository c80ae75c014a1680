// Rotations by small vectors, as error-state filters use them. A rotation vector points along the axis and is as long
// as the angle in radians (Sola 2017, "Quaternion kinematics for the error-state Kalman filter", section 2.3 and 4).
#pragma once

#include <Eigen/Geometry>

namespace locus {

/// The matrix of the cross product: skew(a) b = a x b.
inline Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
    return (Eigen::Matrix3d() << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0).finished();
}

/// Rotation vector, rad -> quaternion; exact at any length, also at none (Sola eq. 101).
inline Eigen::Quaterniond rotation(const Eigen::Vector3d& vector_rad) {
    const double half = 0.5 * vector_rad.norm();
    const double sinc_half = half < 1e-4 ? 0.5 * (1 - half * half / 6) : 0.5 * std::sin(half) / half;
    const Eigen::Vector3d imaginary = sinc_half * vector_rad;
    return {std::cos(half), imaginary.x(), imaginary.y(), imaginary.z()};
}

/// Heading of a body, rad, counter-clockwise about the z axis from the x axis: where the body's x axis points.
inline double heading_rad(const Eigen::Quaterniond& body_to_level) {
    const Eigen::Vector3d forward = body_to_level * Eigen::Vector3d::UnitX();
    return std::atan2(forward.y(), forward.x());
}

/// Level attitude from a specific force at rest, heading zero: the shortest turn that brings it upright.
inline Eigen::Quaterniond levelled(const Eigen::Vector3d& specific_force_body) {
    return Eigen::Quaterniond::FromTwoVectors(specific_force_body, Eigen::Vector3d::UnitZ());
}

} // namespace locus
