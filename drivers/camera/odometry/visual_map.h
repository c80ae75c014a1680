// The map that visual odometry makes for itself and forgets behind itself: key frames, and the points that they see.
#pragma once

#include "drivers/camera/odometry/camera_pose.h"
#include "drivers/camera/odometry/features.h"

#include <map>
#include <unordered_map>
#include <vector>

namespace locus::camera {

using PointId = std::uint32_t;
using KeyId = std::uint32_t; ///< rises in order of time
inline constexpr PointId no_point = 0;

struct MapPoint {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector3d towards = Eigen::Vector3d::Zero(); ///< from the camera that saw it last; of unit length
    double reach = 0;                                  ///< distance from which it would be seen in the finest scale
    Descriptor descriptor{};                           ///< as it was seen last
    std::map<KeyId, std::size_t> seen_as;              ///< key frames and their features
    KeyId born = 0;
    int expected = 0, found = 0; ///< in how many frames it should have been seen, and was
};

struct KeyFrame {
    CameraPose pose;
    Features features;
    std::vector<PointId> points; ///< of each feature
};

class VisualMap {
  public:
    KeyId add_key_frame(KeyFrame frame);
    PointId add_point(const Eigen::Vector3d& position, KeyId born);
    void connect(PointId point, KeyId key, std::size_t feature);
    void disconnect(PointId point, KeyId key);
    void remove_point(PointId point);
    /// Points that nobody else sees go with it.
    void remove_key_frame(KeyId key);

    std::map<KeyId, KeyFrame>& keys() { return keys_; }
    const std::map<KeyId, KeyFrame>& keys() const { return keys_; }
    KeyFrame& key(KeyId id) { return keys_.at(id); }
    KeyId newest() const { return keys_.rbegin()->first; }
    std::unordered_map<PointId, MapPoint>& points() { return points_; }
    const std::unordered_map<PointId, MapPoint>& points() const { return points_; }
    bool has(PointId id) const { return points_.contains(id); }

    /// Key frames that see any of these points, those with the most first.
    std::vector<std::pair<KeyId, int>> seen_by(const std::vector<PointId>& points) const;

    /// Lengths of the map from now on count so many times as much.
    void stretch(double factor);

  private:
    std::map<KeyId, KeyFrame> keys_;
    std::unordered_map<PointId, MapPoint> points_;
    KeyId next_key_ = 1;
    PointId next_point_ = 1;
};

/// Its direction, reach and look, as the key frame sees it.
void look_anew(MapPoint& point, const KeyFrame& frame, std::size_t feature);

/// Median distance of a key frame's points along its axis; 0 without any.
double median_depth(const VisualMap& map, const KeyFrame& frame);

} // namespace locus::camera
