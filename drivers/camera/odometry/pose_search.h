// A pose from points and the features that may show them, some of which are wrong.
#pragma once

#include "drivers/camera/odometry/projection_search.h"

#include <optional>

namespace locus::camera {

/// PnP with RANSAC. Takes what does not fit out of `points` (one for each feature). Empty, and `points` anything, where
/// no pose explains enough.
std::optional<CameraPose> find_pose(const VisualMap& map, const Features& features, double focal_px,
                                    std::vector<PointId>& points);

/// The best pose from a good guess on, by least squares; points that do not fit it go.
CameraPose refine_pose(const VisualMap& map, const Features& features, double focal_px, const CameraPose& guess,
                       std::vector<PointId>& points);

std::size_t count_points(const std::vector<PointId>& points);

} // namespace locus::camera
