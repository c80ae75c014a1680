#include "drivers/camera/odometry/joined_sights.h"

#include "drivers/camera/odometry/triangulate.h"

namespace locus::camera {
namespace {

constexpr double join_radius_px = 3;
constexpr int most_different_joined = 50; // Mur-Artal 2015's code words it "low"; as for new points

/// The one that fewer key frames see goes; the other takes its sights over, but where it has one already.
void make_one(VisualMap& map, PointId a, PointId b) {
    const bool keeps_a = map.points().at(a).seen_as.size() >= map.points().at(b).seen_as.size();
    const PointId kept = keeps_a ? a : b, gone = keeps_a ? b : a;
    const auto sights = map.points().at(gone).seen_as;
    MapPoint& point = map.points().at(kept);
    point.expected += map.points().at(gone).expected;
    point.found += map.points().at(gone).found;
    map.remove_point(gone);
    for (const auto& [key, feature] : sights)
        if (!point.seen_as.contains(key)) map.connect(kept, key, feature);
}

} // namespace

void join_sights(VisualMap& map, KeyId from, KeyId into, const IdealCamera& camera) {
    std::vector<PointId> wanted;
    for (const PointId id : map.key(from).points)
        if (id != no_point && !map.points().at(id).seen_as.contains(into)) wanted.push_back(id);
    KeyFrame& frame = map.key(into);
    const FeatureGrid grid(frame.features);
    std::vector<PointId> found(frame.features.size(), no_point), expected;
    search_points(map, wanted, frame.pose, camera, frame.features, grid,
                  {.radius_px = join_radius_px, .most_different = most_different_joined}, found, expected);
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i] == no_point || !map.has(found[i])) continue;
        if (misfit(map.points().at(found[i]).position, {frame.pose, frame.features[i]}, camera.focal_px) >
            most_off_point)
            continue;
        if (frame.points[i] == no_point)
            map.connect(found[i], into, i);
        else
            make_one(map, found[i], frame.points[i]);
    }
}

} // namespace locus::camera
