// Points that two key frames see and the map does not know yet.
#pragma once

#include "drivers/camera/odometry/visual_map.h"

namespace locus::camera {

/// Features of both without a point that look alike, lie on each other's epipolar line and meet in front of both become
/// points.
void add_new_points(VisualMap& map, KeyId newest, KeyId neighbour, double focal_px);

} // namespace locus::camera
