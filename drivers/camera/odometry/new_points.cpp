#include "drivers/camera/odometry/new_points.h"

#include "drivers/camera/odometry/triangulate.h"

#include <limits>
#include <numbers>

namespace locus::camera {
namespace {

/// Mur-Artal 2015, section VI-C: what a pair must at least be like; and half as strict an angle as its start has.
constexpr int most_different_pair = 50;
constexpr double least_new_parallax = 1. * std::numbers::pi / 180;
/// A line has many features on it: the second choice must differ by clearly more (Lowe 2004, fig. 11). Without this the
/// scale ran away, by 4 % a corner of the drawn room, for wrong points are mostly too near.
constexpr double second_on_line = 0.8;
/// Scales and distances must go together, with a step of scale and a half to spare.
constexpr double ratio_to_spare = 1.5 * octave_ratio;

/// From slopes of the first to lines of the second (Longuet-Higgins 1981).
Eigen::Matrix3d essential_of(const CameraPose& second_from_first) {
    const Eigen::Vector3d& t = second_from_first.map_in_camera;
    Eigen::Matrix3d cross;
    cross << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
    return cross * second_from_first.camera_from_map.toRotationMatrix();
}

/// Of the free features of `there`, the one most like `feature` among those on its line; size() if none.
std::size_t best_on_line(const Feature& feature, const Eigen::Vector3d& line, const KeyFrame& there, double focal_px) {
    std::size_t best = there.features.size();
    int least = most_different_pair + 1, next = 256;
    const double norm = line.head<2>().norm();
    for (std::size_t i = 0; i < there.features.size(); ++i) {
        if (there.points[i] != no_point) continue;
        const Feature& other = there.features[i];
        const double off_px = std::abs(line.head<2>().dot(other.at_px) + focal_px * line.z()) / norm;
        if (off_px * off_px > most_off_line * other.sigma_px() * other.sigma_px()) continue;
        const int different = difference(feature.descriptor, other.descriptor);
        if (different >= least) {
            next = std::min(next, different);
            continue;
        }
        if (best < there.features.size()) next = least;
        least = different;
        best = i;
    }
    if (best < there.features.size() && least > second_on_line * next) return there.features.size();
    return best;
}

bool scales_agree(const Eigen::Vector3d& place, const SightLine& a, const SightLine& b) {
    const double by_distance = (place - b.pose.centre()).norm() / (place - a.pose.centre()).norm();
    const double by_scale = octave_scale(a.feature.octave) / octave_scale(b.feature.octave);
    return by_distance < by_scale * ratio_to_spare && by_distance * ratio_to_spare > by_scale;
}

} // namespace

void add_new_points(VisualMap& map, KeyId newest, KeyId neighbour, double focal_px) {
    const KeyFrame &here = map.key(newest), &there = map.key(neighbour);
    const Eigen::Matrix3d essential = essential_of(there.pose * here.pose.inverse());
    for (std::size_t i = 0; i < here.features.size(); ++i) {
        if (here.points[i] != no_point) continue;
        const Feature& feature = here.features[i];
        const Eigen::Vector3d line = essential * (feature.at_px / focal_px).homogeneous();
        const std::size_t j = best_on_line(feature, line, there, focal_px);
        if (j == there.features.size()) continue;
        const SightLine a{here.pose, feature}, b{there.pose, there.features[j]};
        const auto place = triangulate(a, b, focal_px, least_new_parallax);
        if (!place.has_value() || !scales_agree(place.value(), a, b)) continue;
        const PointId point = map.add_point(place.value(), newest);
        map.connect(point, neighbour, j);
        map.connect(point, newest, i);
    }
}

} // namespace locus::camera
