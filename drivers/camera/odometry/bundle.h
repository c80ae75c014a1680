// Bundle adjustment: camera poses and points together, to where the features were seen, with Huber's loss (Triggs et
// al. 1999, "Bundle adjustment: a modern synthesis"); solved by Ceres.
#pragma once

#include "drivers/camera/odometry/visual_map.h"

#include <span>
#include <vector>

namespace locus::camera {

/// A feature that was seen of a point whose place is taken as known.
struct KnownSight {
    Eigen::Vector3d point;
    const Feature* feature = nullptr;
};

/// The pose that fits best, from `start` on.
CameraPose fit_pose(const CameraPose& start, std::span<const KnownSight> sights, double focal_px);

/// The poses of `free` and all points that they see move; the other key frames that see those points hold them. Sights
/// that do not fit afterwards are taken out of the map.
void adjust_bundle(VisualMap& map, const std::vector<KeyId>& free, double focal_px);

} // namespace locus::camera
