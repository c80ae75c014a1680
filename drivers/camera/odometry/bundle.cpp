#include "drivers/camera/odometry/bundle.h"

#include "drivers/camera/odometry/triangulate.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <algorithm>
#include <array>

namespace locus::camera {
namespace {

constexpr int most_rounds = 8; ///< of a window that starts where the last one ended

/// What comes to lie behind the camera on the way is very wrong, but no reason to stop.
constexpr double nearest = 1e-3;

/// A pose as Ceres moves it: rotation vector, then shift.
using PoseBlock = std::array<double, 6>;

PoseBlock block_of(const CameraPose& pose) {
    const Eigen::AngleAxisd turn(pose.camera_from_map);
    const Eigen::Vector3d vector = turn.angle() * turn.axis();
    return {vector.x(), vector.y(), vector.z(), pose.map_in_camera.x(), pose.map_in_camera.y(), pose.map_in_camera.z()};
}

CameraPose pose_of(const PoseBlock& block) {
    const Eigen::Vector3d vector(block[0], block[1], block[2]);
    const double angle = vector.norm();
    const Eigen::Vector3d axis = angle > 0 ? Eigen::Vector3d(vector / angle) : Eigen::Vector3d::UnitX();
    return {Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis)), {block[3], block[4], block[5]}};
}

struct Reprojection {
    Eigen::Vector2d at_px;
    double focal_px, sigma_px;

    template <class T>
    bool operator()(const T* pose, const T* point, T* residual) const {
        std::array<T, 3> seen;
        ceres::AngleAxisRotatePoint(pose, point, seen.data());
        for (std::size_t i = 0; i < 3; ++i) seen[i] += pose[3 + i];
        if (seen[2] < T(nearest)) seen[2] = T(nearest);
        residual[0] = (focal_px * seen[0] / seen[2] - at_px.x()) / sigma_px;
        residual[1] = (focal_px * seen[1] / seen[2] - at_px.y()) / sigma_px;
        return true;
    }
};

struct ReprojectionOfKnown {
    Reprojection reprojection;
    Eigen::Vector3d point;

    template <class T>
    bool operator()(const T* pose, T* residual) const {
        const std::array<T, 3> there{T(point.x()), T(point.y()), T(point.z())};
        return reprojection(pose, there.data(), residual);
    }
};

ceres::LossFunction* huber() { return new ceres::HuberLoss(std::sqrt(most_off_point)); }

ceres::Solver::Options options(ceres::LinearSolverType solver, int rounds) {
    ceres::Solver::Options options;
    options.linear_solver_type = solver;
    options.dense_linear_algebra_library_type = ceres::EIGEN; // LAPACK may have threads of its own
    options.num_threads = 1;
    options.max_num_iterations = rounds;
    options.function_tolerance = 1e-4;
    options.logging_type = ceres::SILENT;
    return options;
}

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

CameraPose fit_pose(const CameraPose& start, std::span<const KnownSight> sights, double focal_px) {
    PoseBlock pose = block_of(start);
    ceres::Problem problem;
    for (const auto& [point, feature] : sights)
        problem.AddResidualBlock(new ceres::AutoDiffCostFunction<ReprojectionOfKnown, 2, 6>(
                                     new ReprojectionOfKnown{{feature->at_px, focal_px, feature->sigma_px()}, point}),
                                 huber(), pose.data());
    ceres::Solver::Summary summary;
    ceres::Solve(options(ceres::DENSE_NORMAL_CHOLESKY, most_rounds), &problem, &summary);
    return summary.IsSolutionUsable() ? pose_of(pose) : start;
}

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
    auto solving = options(ceres::DENSE_SCHUR, most_rounds);
    solving.linear_solver_ordering.reset(order);
    ceres::Solver::Summary summary;
    ceres::Solve(solving, &problem, &summary);
    if (!summary.IsSolutionUsable()) return;
    for (const auto& [key, at] : window.key_at) map.key(key).pose = pose_of(window.poses[at]);
    for (const auto& [id, at] : window.point_at) map.points().at(id).position = window.points[at];
    drop_wrong_sights(map, window, focal_px);
}

} // namespace locus::camera
