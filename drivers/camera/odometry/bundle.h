// Bundle adjustment: camera poses and points together, to where the features were seen, with Huber's loss (Triggs et
// al. 1999, "Bundle adjustment: a modern synthesis"); solved by Ceres.
#pragma once

#include "drivers/camera/odometry/visual_map.h"

#include <vector>

namespace locus::camera {

/// The poses of `free` and all points that they see move; the other key frames that see those points hold them. Sights
/// that do not fit afterwards are taken out of the map.
void adjust_bundle(VisualMap& map, const std::vector<KeyId>& free, double focal_px);

} // namespace locus::camera
