// When a picture is worth keeping: once it sees clearly less of the map than the last key frame, or from clearly
// elsewhere.
#pragma once

#include "drivers/camera/odometry/map_tracker.h"

namespace locus::camera {

class KeyFrameChoice {
  public:
    /// A key frame was made that saw so many points of the map.
    void start(std::size_t seen) { seen_ = seen; }

    bool wants(const VisualMap& map, const Tracked& now) const {
        const KeyFrame& newest = map.keys().rbegin()->second;
        const double way = (now.pose.centre() - newest.pose.centre()).norm();
        const double turn_rad = now.pose.camera_from_map.angularDistance(newest.pose.camera_from_map);
        const bool sees_less = static_cast<double>(now.count) < least_share * static_cast<double>(seen_);
        return sees_less || way > far * median_depth(map, newest) || turn_rad > turned_rad;
    }

  private:
    static constexpr double least_share = 0.85;
    static constexpr double far = 0.08;       ///< of the depth: half of the baseline that a start takes
    static constexpr double turned_rad = 0.2; ///< a sixth of a usual picture's width

    std::size_t seen_ = 0; ///< points of the map, before the last key frame brought new ones
};

} // namespace locus::camera
