#include "drivers/camera/odometry/map_tracker.h"

#include "drivers/camera/odometry/feature_matches.h"
#include "drivers/camera/odometry/pose_search.h"

#include <unordered_set>

namespace locus::camera {
namespace {

/// Around where the last motion says, and where a pose says that is known already.
constexpr double guessed_radius_px = 15, known_radius_px = 5;
/// Of the neighbourhood: key frames that see most of what was seen a moment ago.
constexpr std::size_t most_neighbours = 15;

std::vector<PointId> known_of(const VisualMap& map, const std::vector<PointId>& points) {
    std::vector<PointId> known;
    for (const PointId id : points)
        if (id != no_point && map.has(id)) known.push_back(id);
    return known;
}

std::vector<PointId> neighbourhood(const VisualMap& map, const std::vector<PointId>& points) {
    auto frames = map.seen_by(points);
    if (frames.size() > most_neighbours) frames.resize(most_neighbours);
    std::unordered_set<PointId> seen;
    std::vector<PointId> all;
    for (const auto& [key, shared] : frames)
        for (const PointId id : map.keys().at(key).points)
            if (id != no_point && seen.insert(id).second) all.push_back(id);
    return all;
}

/// Nothing but looks: what the newest key frame saw.
std::vector<PointId> match_newest(const VisualMap& map, const Features& features) {
    const KeyFrame& newest = map.keys().rbegin()->second;
    std::vector<PointId> ids;
    std::vector<Descriptor> looks;
    for (const PointId id : newest.points)
        if (id != no_point) {
            ids.push_back(id);
            looks.push_back(map.points().at(id).descriptor);
        }
    std::vector<PointId> points(features.size(), no_point);
    for (const auto& [known, feature] : match_features(looks, descriptors_of(features))) points[feature] = ids[known];
    return points;
}

} // namespace

std::optional<Tracked> track_map(const VisualMap& map, const Features& features, const IdealCamera& camera,
                                 const CameraPose& guess, const std::vector<PointId>& last) {
    if (features.empty()) return std::nullopt;
    const FeatureGrid grid(features);
    const std::vector<PointId> known = known_of(map, last);
    std::vector<PointId> points(features.size(), no_point), passed;
    search_points(map, known, guess, camera, features, grid, {.radius_px = guessed_radius_px}, points, passed);
    auto pose =
        count_points(points) >= least_tracked ? find_pose(map, features, camera.focal_px, points) : std::nullopt;
    if (!pose.has_value() || count_points(points) < least_tracked) {
        points = match_newest(map, features);
        pose = find_pose(map, features, camera.focal_px, points);
    }
    if (!pose.has_value()) return std::nullopt;
    Tracked tracked;
    tracked.pose = refine_pose(map, features, camera.focal_px, pose.value(), points);
    const auto near = neighbourhood(map, known.empty() ? known_of(map, map.keys().rbegin()->second.points) : known);
    for (const PointId id : points)
        if (id != no_point) tracked.expected.push_back(id);
    search_points(map, near, tracked.pose, camera, features, grid, {.radius_px = known_radius_px}, points,
                  tracked.expected);
    tracked.pose = refine_pose(map, features, camera.focal_px, tracked.pose, points);
    tracked.count = count_points(points);
    tracked.points = std::move(points);
    if (tracked.count < least_tracked) return std::nullopt;
    return tracked;
}

} // namespace locus::camera
