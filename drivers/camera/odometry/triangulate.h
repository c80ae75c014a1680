// A point from two sights of it, and whether those sights can tell.
#pragma once

#include "drivers/camera/odometry/camera_pose.h"
#include "drivers/camera/odometry/features.h"

#include <optional>

namespace locus::camera {

/// What a squared distance in sigmas may be before it is called wrong: 95 % of a chi-square variable with one and with
/// two degrees of freedom.
inline constexpr double most_off_line = 3.84, most_off_point = 5.99;

/// A feature and where the camera was that saw it.
struct SightLine {
    const CameraPose& pose;
    const Feature& feature;
};

/// Squared distance between where a point should be seen and where it is, in sigmas; infinite behind the camera.
double misfit(const Eigen::Vector3d& point_map, const SightLine& sight, double focal_px);

/// The point of the map that both see; empty where it lies behind one of them, fits one badly, or where the two lines
/// of sight meet at less than `least_parallax_rad`.
std::optional<Eigen::Vector3d> triangulate(const SightLine& a, const SightLine& b, double focal_px,
                                           double least_parallax_rad);

/// Angle at a point between two places.
double parallax_rad(const Eigen::Vector3d& point, const Eigen::Vector3d& from_a, const Eigen::Vector3d& from_b);

} // namespace locus::camera
