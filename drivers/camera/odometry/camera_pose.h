// Where a camera is in a map: the one transform of visual odometry. Camera axes: x to the right, y down, z forward.
#pragma once

#include <Eigen/Geometry>

namespace locus::camera {

struct CameraPose {
    Eigen::Quaterniond camera_from_map = Eigen::Quaterniond::Identity();
    Eigen::Vector3d map_in_camera = Eigen::Vector3d::Zero(); ///< the map's origin

    Eigen::Vector3d to_camera(const Eigen::Vector3d& in_map) const { return camera_from_map * in_map + map_in_camera; }
    Eigen::Vector3d to_map(const Eigen::Vector3d& in_camera) const {
        return camera_from_map.conjugate() * (in_camera - map_in_camera);
    }
    Eigen::Vector3d centre() const { return to_map(Eigen::Vector3d::Zero()); }

    CameraPose inverse() const { return {camera_from_map.conjugate(), camera_from_map.conjugate() * -map_in_camera}; }
    /// `this` after `first`.
    CameraPose operator*(const CameraPose& first) const {
        return {(camera_from_map * first.camera_from_map).normalized(), to_camera(first.map_in_camera)};
    }
};

} // namespace locus::camera
