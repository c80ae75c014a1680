#include "drivers/camera/odometry/map_maker.h"

#include "drivers/camera/odometry/bundle.h"
#include "drivers/camera/odometry/joined_sights.h"
#include "drivers/camera/odometry/new_points.h"

#include <algorithm>

namespace locus::camera {
namespace {

/// Key frames that move in an adjustment, and those in which new points are looked for.
constexpr std::size_t adjusted = 10, looked_at = 8;
/// A way shorter than this share of the depth gives no new points.
constexpr double least_way = 0.02;
/// A point must be found in so many of the pictures that should show it, and be in three key frames once two came
/// after its own (Mur-Artal 2015, section VI-B).
constexpr double least_found = 0.25;
constexpr std::size_t least_seen = 3;
constexpr KeyId on_trial = 2;

std::vector<PointId> points_of(const KeyFrame& frame) {
    std::vector<PointId> points;
    for (const PointId id : frame.points)
        if (id != no_point) points.push_back(id);
    return points;
}

void remove_unproven(VisualMap& map, KeyId newest) {
    std::vector<PointId> gone;
    for (const auto& [id, point] : map.points()) {
        const bool is_seldom = point.found < least_found * point.expected;
        const bool is_new = newest - point.born == on_trial && point.born > 2;
        if (is_seldom || (is_new && point.seen_as.size() < least_seen)) gone.push_back(id);
    }
    for (const PointId id : gone) map.remove_point(id);
}

std::vector<KeyId> neighbours_of(const VisualMap& map, KeyId key, std::size_t most) {
    std::vector<KeyId> near;
    for (const auto& [other, shared] : map.seen_by(points_of(map.keys().at(key))))
        if (other != key && near.size() < most) near.push_back(other);
    return near;
}

void look_for_new_points(VisualMap& map, KeyId newest, const IdealCamera& camera) {
    const double depth = median_depth(map, map.key(newest));
    const auto near = neighbours_of(map, newest, looked_at);
    for (const KeyId other : near) {
        const double way = (map.key(newest).pose.centre() - map.key(other).pose.centre()).norm();
        if (way > least_way * depth) add_new_points(map, newest, other, camera.focal_px);
    }
    for (const KeyId other : near) join_sights(map, newest, other, camera);
    for (const KeyId other : near) join_sights(map, other, newest, camera);
}

/// The newest and its neighbours; two key frames at least stay, or the scale would be free.
std::vector<KeyId> window_around(const VisualMap& map, KeyId newest) {
    std::vector<KeyId> window = neighbours_of(map, newest, adjusted - 1);
    window.push_back(newest);
    std::sort(window.begin(), window.end());
    std::vector<PointId> seen;
    for (const KeyId key : window)
        for (const PointId id : points_of(map.keys().at(key))) seen.push_back(id);
    const std::size_t holding = map.seen_by(seen).size() - window.size();
    if (holding < 2) window.erase(window.begin(), window.begin() + static_cast<std::ptrdiff_t>(2 - holding));
    return window;
}

} // namespace

VisualMap start_map(const Features& first, const Features& second, const TwoView& view, const IdealCamera& camera) {
    VisualMap map;
    const auto empty = [](const Features& features) { return std::vector<PointId>(features.size(), no_point); };
    const KeyId a = map.add_key_frame({{}, first, empty(first)});
    const KeyId b = map.add_key_frame({view.second_from_first, second, empty(second)});
    for (const auto& [match, place] : view.points) {
        const PointId id = map.add_point(place, b);
        map.connect(id, a, match.first);
        map.connect(id, b, match.second);
    }
    adjust_bundle(map, {b}, camera.focal_px);
    const double depth = median_depth(map, map.key(a));
    if (depth > 0) map.stretch(1 / depth);
    return map;
}

KeyId grow_map(VisualMap& map, KeyFrame frame, const IdealCamera& camera, std::size_t most_key_frames) {
    const KeyId newest = map.add_key_frame(std::move(frame));
    remove_unproven(map, newest);
    look_for_new_points(map, newest, camera);
    const auto window = window_around(map, newest);
    if (!window.empty()) adjust_bundle(map, window, camera.focal_px);
    while (map.keys().size() > most_key_frames) map.remove_key_frame(map.keys().begin()->first);
    return newest;
}

} // namespace locus::camera
