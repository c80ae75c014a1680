// A map grows by a key frame: new points where two key frames see the same thing from different places, all of it
// adjusted to what was seen; what did not prove itself goes, and so does what lies far behind.
#pragma once

#include "drivers/camera/odometry/projection_search.h"
#include "drivers/camera/odometry/two_view.h"

namespace locus::camera {

/// Two key frames and the points that both see, adjusted; the points' median depth is one.
VisualMap start_map(const Features& first, const Features& second, const TwoView& view, const IdealCamera& camera);

/// `points`: those of the map that the features show. The key frame's pose is adjusted.
KeyId grow_map(VisualMap& map, KeyFrame frame, const IdealCamera& camera, std::size_t most_key_frames);

} // namespace locus::camera
