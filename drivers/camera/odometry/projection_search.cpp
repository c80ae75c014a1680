#include "drivers/camera/odometry/projection_search.h"

#include <algorithm>
#include <limits>
#include <unordered_set>

namespace locus::camera {
namespace {

/// Seen from another side than this it looks different (Mur-Artal 2015, section V-D).
constexpr double least_cosine = 0.5;
/// The second choice must differ by more, if it is of the same scale.
constexpr double second_found = 0.8;

struct Found {
    std::size_t feature = 0;
    int different = std::numeric_limits<int>::max();
    bool is_clear = false;
};

Found look_up(const MapPoint& point, const Expectation& expected, const Features& features, const FeatureGrid& grid,
              double radius_px) {
    Found best;
    int second = std::numeric_limits<int>::max(), second_octave = -1;
    grid.near(expected.at_px, radius_px * octave_scale(expected.octave), [&](std::size_t i) {
        if (std::abs(features[i].octave - expected.octave) > 1) return;
        const int different = difference(point.descriptor, features[i].descriptor);
        if (different < best.different) {
            second = best.different;
            second_octave = second == std::numeric_limits<int>::max() ? -1 : features[best.feature].octave;
            best = {i, different, false};
        } else if (different < second) {
            second = different;
            second_octave = features[i].octave;
        }
    });
    if (best.different == std::numeric_limits<int>::max()) return best;
    best.is_clear = second_octave != features[best.feature].octave || best.different < second_found * second;
    return best;
}

} // namespace

std::optional<Expectation> expect(const MapPoint& point, const CameraPose& pose, const IdealCamera& camera) {
    const Eigen::Vector3d seen = pose.to_camera(point.position);
    if (!(seen.z() > 0)) return std::nullopt;
    const Eigen::Vector2d at_px = camera.focal_px * seen.hnormalized();
    if ((at_px.cwiseAbs().array() > camera.half_px.array()).any()) return std::nullopt;
    const Eigen::Vector3d towards = pose.camera_from_map.conjugate() * seen.normalized();
    if (towards.dot(point.towards) < least_cosine) return std::nullopt;
    const double octave = std::round(std::log(point.reach / seen.norm()) / std::log(octave_ratio));
    if (octave < -1 || octave > octaves) return std::nullopt;
    return Expectation{at_px, std::clamp(static_cast<int>(octave), 0, octaves - 1)};
}

void search_points(const VisualMap& map, const std::vector<PointId>& wanted, const CameraPose& pose,
                   const IdealCamera& camera, const Features& features, const FeatureGrid& grid,
                   const SearchSettings& settings, std::vector<PointId>& points, std::vector<PointId>& expected) {
    const std::unordered_set<PointId> known(points.begin(), points.end());
    std::vector<int> taken_by(features.size(), std::numeric_limits<int>::max());
    for (const PointId id : wanted) {
        if (known.contains(id)) continue;
        const MapPoint& point = map.points().at(id);
        const auto there = expect(point, pose, camera);
        if (!there.has_value()) continue;
        expected.push_back(id);
        const Found found = look_up(point, there.value(), features, grid, settings.radius_px);
        if (!found.is_clear || found.different > settings.most_different) continue;
        const bool was_free = points[found.feature] == no_point;
        if (!was_free && found.different >= taken_by[found.feature]) continue;
        if (!was_free && taken_by[found.feature] == std::numeric_limits<int>::max()) continue; // known before
        points[found.feature] = id;
        taken_by[found.feature] = found.different;
    }
}

} // namespace locus::camera
