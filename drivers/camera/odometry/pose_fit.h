// Where a camera is that sees known points: least squares of the reprojection with Huber's loss, solved by Ceres.
#pragma once

#include "drivers/camera/odometry/visual_map.h"

#include <span>

namespace locus::camera {

/// A feature that was seen of a point whose place is taken as known.
struct KnownSight {
    Eigen::Vector3d point;
    const Feature* feature = nullptr;
};

/// The pose that fits best, from `start` on.
CameraPose fit_pose(const CameraPose& start, std::span<const KnownSight> sights, double focal_px);

} // namespace locus::camera
