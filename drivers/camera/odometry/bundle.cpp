#include "drivers/camera/odometry/bundle.h"

#include "drivers/camera/odometry/reprojection.h"

#include <algorithm>

namespace locus::camera {
namespace {

/// All that one adjustment moves or is held by. Ceres orders its blocks by their addresses, so they lie in a row: the
/// same pictures give the same poses to the last digit.
struct Window {
    std::map<KeyId, std::size_t> key_at;
    std::map<PointId, std::size_t> point_at;
    std::vector<PoseBlock> poses;
    std::vector<Eigen::Vector3d> points;
};

Window window_of(const VisualMap& map, const std::vector<KeyId>& free) {
    Window window;
    for (const KeyId key : free)
        for (const PointId id : map.keys().at(key).points)
            if (id != no_point) window.point_at.try_emplace(id, 0);
    for (auto& [id, at] : window.point_at) {
        at = window.points.size();
        window.points.push_back(map.points().at(id).position);
        for (const auto& seen : map.points().at(id).seen_as) window.key_at.try_emplace(seen.first, 0);
    }
    for (auto& [key, at] : window.key_at) {
        at = window.poses.size();
        window.poses.push_back(block_of(map.keys().at(key).pose));
    }
    return window;
}

void drop_wrong_sights(VisualMap& map, const Window& window, double focal_px) {
    for (const auto& [id, at] : window.point_at) {
        std::vector<KeyId> wrong;
        for (const auto& [key, feature] : map.points().at(id).seen_as) {
            const KeyFrame& frame = map.keys().at(key);
            if (misfit(window.points[at], {frame.pose, frame.features[feature]}, focal_px) > most_off_point)
                wrong.push_back(key);
        }
        for (const KeyId key : wrong)
            if (map.has(id)) map.disconnect(id, key);
    }
}

} // namespace

void adjust_bundle(VisualMap& map, const std::vector<KeyId>& free, double focal_px) {
    Window window = window_of(map, free);
    ceres::Problem problem;
    auto* order = new ceres::ParameterBlockOrdering;
    for (const auto& [id, at] : window.point_at)
        for (const auto& [key, index] : map.points().at(id).seen_as) {
            const Feature& feature = map.keys().at(key).features[index];
            problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Reprojection, 2, 6, 3>(
                                         new Reprojection{feature.at_px, focal_px, feature.sigma_px()}),
                                     huber(), window.poses[window.key_at.at(key)].data(), window.points[at].data());
        }
    for (auto& place : window.points) order->AddElementToGroup(place.data(), 0);
    for (const auto& [key, at] : window.key_at) {
        order->AddElementToGroup(window.poses[at].data(), 1);
        if (std::find(free.begin(), free.end(), key) == free.end())
            problem.SetParameterBlockConstant(window.poses[at].data());
    }
    auto solving = solver_options(ceres::DENSE_SCHUR);
    solving.linear_solver_ordering.reset(order);
    ceres::Solver::Summary summary;
    ceres::Solve(solving, &problem, &summary);
    if (!summary.IsSolutionUsable()) return;
    for (const auto& [key, at] : window.key_at) map.key(key).pose = pose_of(window.poses[at]);
    for (const auto& [id, at] : window.point_at) map.points().at(id).position = window.points[at];
    drop_wrong_sights(map, window, focal_px);
}

} // namespace locus::camera
