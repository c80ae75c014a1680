// Where the camera is against a map: points of the neighbourhood are looked up where the last motion says they should
// be, the pose comes from those found (PnP with RANSAC), and is refined on all that can then be found.
#pragma once

#include "drivers/camera/odometry/projection_search.h"

#include <optional>

namespace locus::camera {

struct Tracked {
    CameraPose pose;
    std::vector<PointId> points;   ///< of each feature; only those that fit the pose
    std::vector<PointId> expected; ///< those of the neighbourhood that should be in the picture
    std::size_t count = 0;         ///< of points
};

/// Fewer points that fit are no pose: twice the least for which chance alone was not seen to agree (Mur-Artal 2015,
/// section V-E, takes as many matches to be sure of a place).
inline constexpr std::size_t least_tracked = 20;

/// `last`: points that were tracked in the picture before. Empty when the place cannot be told.
std::optional<Tracked> track_map(const VisualMap& map, const Features& features, const IdealCamera& camera,
                                 const CameraPose& guess, const std::vector<PointId>& last);

} // namespace locus::camera
