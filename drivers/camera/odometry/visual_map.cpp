#include "drivers/camera/odometry/visual_map.h"

#include <algorithm>

namespace locus::camera {

KeyId VisualMap::add_key_frame(KeyFrame frame) {
    const KeyId id = next_key_++;
    KeyFrame& kept = keys_.emplace(id, std::move(frame)).first->second;
    for (std::size_t i = 0; i < kept.points.size(); ++i)
        if (kept.points[i] != no_point) connect(kept.points[i], id, i);
    return id;
}

PointId VisualMap::add_point(const Eigen::Vector3d& position, KeyId born) {
    MapPoint point;
    point.position = position;
    point.born = born;
    points_.emplace(next_point_, std::move(point));
    return next_point_++;
}

void VisualMap::connect(PointId point, KeyId key, std::size_t feature) {
    KeyFrame& frame = keys_.at(key);
    MapPoint& known = points_.at(point);
    frame.points[feature] = point;
    known.seen_as[key] = feature;
    if (known.seen_as.rbegin()->first == key) look_anew(known, frame, feature);
}

void VisualMap::disconnect(PointId point, KeyId key) {
    MapPoint& known = points_.at(point);
    const auto seen = known.seen_as.find(key);
    if (seen == known.seen_as.end()) return;
    keys_.at(key).points[seen->second] = no_point;
    known.seen_as.erase(seen);
    if (known.seen_as.size() < 2) remove_point(point);
}

void VisualMap::remove_point(PointId point) {
    for (const auto& [key, feature] : points_.at(point).seen_as) keys_.at(key).points[feature] = no_point;
    points_.erase(point);
}

void VisualMap::remove_key_frame(KeyId key) {
    const std::vector<PointId> points = keys_.at(key).points;
    for (const PointId point : points)
        if (point != no_point && has(point)) disconnect(point, key);
    keys_.erase(key);
}

std::vector<std::pair<KeyId, int>> VisualMap::seen_by(const std::vector<PointId>& points) const {
    std::map<KeyId, int> shared;
    for (const PointId id : points) {
        const auto point = points_.find(id);
        if (point == points_.end()) continue;
        for (const auto& seen : point->second.seen_as) ++shared[seen.first];
    }
    std::vector<std::pair<KeyId, int>> all(shared.begin(), shared.end());
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
        return a.second != b.second ? a.second > b.second : a.first > b.first;
    });
    return all;
}

void VisualMap::stretch(double factor) {
    for (auto& [id, frame] : keys_) frame.pose.map_in_camera *= factor;
    for (auto& [id, point] : points_) {
        point.position *= factor;
        point.reach *= factor;
    }
}

void look_anew(MapPoint& point, const KeyFrame& frame, std::size_t feature) {
    const Eigen::Vector3d from_camera = point.position - frame.pose.centre();
    const double distance = from_camera.norm();
    point.towards = from_camera / distance;
    point.reach = distance * octave_scale(frame.features[feature].octave);
    point.descriptor = frame.features[feature].descriptor;
}

double median_depth(const VisualMap& map, const KeyFrame& frame) {
    std::vector<double> depths;
    for (const PointId id : frame.points)
        if (id != no_point) depths.push_back(frame.pose.to_camera(map.points().at(id).position).z());
    if (depths.empty()) return 0;
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    return *middle;
}

} // namespace locus::camera
