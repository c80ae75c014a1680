// What one key frame sees is looked up in its neighbours, so that each point is held by as many sights as there are,
// and what two key frames hold as two points becomes one.
#pragma once

#include "drivers/camera/odometry/projection_search.h"

namespace locus::camera {

/// The points of `from` that `into` should see as well.
void join_sights(VisualMap& map, KeyId from, KeyId into, const IdealCamera& camera);

} // namespace locus::camera
