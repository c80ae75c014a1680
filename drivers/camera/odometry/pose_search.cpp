#include "drivers/camera/odometry/pose_search.h"

#include "drivers/camera/odometry/pose_fit.h"
#include "drivers/camera/odometry/triangulate.h"

#include <opencv2/calib3d.hpp>

#include <algorithm>

namespace locus::camera {
namespace {

constexpr std::size_t least_for_pose = 10;
constexpr int most_pnp_draws = 100;
constexpr double pnp_certainty = 0.99;
/// For features of all scales together: 95 % of those of the fourth.
constexpr float wide_px = 4;

struct Pairs {
    std::vector<cv::Point3d> points;
    std::vector<cv::Point2d> at_px;
    std::vector<std::size_t> feature;
};

Pairs pairs_of(const VisualMap& map, const Features& features, const std::vector<PointId>& points) {
    Pairs pairs;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i] == no_point) continue;
        const Eigen::Vector3d& place = map.points().at(points[i]).position;
        pairs.points.emplace_back(place.x(), place.y(), place.z());
        pairs.at_px.emplace_back(features[i].at_px.x(), features[i].at_px.y());
        pairs.feature.push_back(i);
    }
    return pairs;
}

void drop_misfits(const VisualMap& map, const Features& features, double focal_px, const CameraPose& pose,
                  std::vector<PointId>& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i] == no_point) continue;
        const SightLine sight{pose, features[i]};
        if (misfit(map.points().at(points[i]).position, sight, focal_px) > most_off_point) points[i] = no_point;
    }
}

} // namespace

std::size_t count_points(const std::vector<PointId>& points) {
    return points.size() - static_cast<std::size_t>(std::count(points.begin(), points.end(), no_point));
}

std::optional<CameraPose> find_pose(const VisualMap& map, const Features& features, double focal_px,
                                    std::vector<PointId>& points) {
    const Pairs pairs = pairs_of(map, features, points);
    if (pairs.points.size() < least_for_pose) return std::nullopt;
    const cv::Matx33d camera(focal_px, 0, 0, 0, focal_px, 0, 0, 0, 1);
    cv::Vec3d turn, shift;
    std::vector<int> fitting;
    if (!cv::solvePnPRansac(pairs.points, pairs.at_px, camera, cv::noArray(), turn, shift, false, most_pnp_draws,
                            wide_px, pnp_certainty, fitting, cv::SOLVEPNP_EPNP) ||
        fitting.size() < least_for_pose)
        return std::nullopt;
    std::vector<PointId> kept(points.size(), no_point);
    for (const int i : fitting) {
        const std::size_t feature = pairs.feature[static_cast<std::size_t>(i)];
        kept[feature] = points[feature];
    }
    points = std::move(kept);
    const Eigen::Vector3d vector(turn[0], turn[1], turn[2]);
    const double angle = vector.norm();
    return CameraPose{Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / std::max(angle, 1e-12))),
                      {shift[0], shift[1], shift[2]}};
}

CameraPose refine_pose(const VisualMap& map, const Features& features, double focal_px, const CameraPose& guess,
                       std::vector<PointId>& points) {
    std::vector<KnownSight> sights;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (points[i] != no_point) sights.push_back({map.points().at(points[i]).position, &features[i]});
    const CameraPose pose = fit_pose(guess, sights, focal_px);
    drop_misfits(map, features, focal_px, pose, points);
    return pose;
}

} // namespace locus::camera
