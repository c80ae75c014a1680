#include "drivers/camera/odometry/bundle.h"

#include "drivers/camera/odometry/triangulate.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <algorithm>
#include <array>
#include <set>

namespace locus::camera {
namespace {

constexpr int most_rounds = 8; ///< of a window that starts where the last one ended

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
        if (seen[2] <= T(1e-6)) return false;
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

/// All that one adjustment moves or is held by.
struct Window {
    std::map<KeyId, PoseBlock> poses;
    std::map<PointId, Eigen::Vector3d> points;
};

Window window_of(const VisualMap& map, const std::vector<KeyId>& free) {
    Window window;
    for (const KeyId key : free)
        for (const PointId id : map.keys().at(key).points)
            if (id != no_point) window.points.try_emplace(id, map.points().at(id).position);
    for (const auto& [id, place] : window.points)
        for (const auto& seen : map.points().at(id).seen_as)
            if (!window.poses.contains(seen.first))
                window.poses.emplace(seen.first, block_of(map.keys().at(seen.first).pose));
    return window;
}

void drop_wrong_sights(VisualMap& map, const Window& window, double focal_px) {
    for (const auto& [id, place] : window.points) {
        std::vector<KeyId> wrong;
        for (const auto& [key, feature] : map.points().at(id).seen_as) {
            const KeyFrame& frame = map.keys().at(key);
            if (misfit(place, {frame.pose, frame.features[feature]}, focal_px) > most_off_point) wrong.push_back(key);
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
    for (auto& [id, place] : window.points)
        for (const auto& [key, index] : map.points().at(id).seen_as) {
            const Feature& feature = map.keys().at(key).features[index];
            problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Reprojection, 2, 6, 3>(
                                         new Reprojection{feature.at_px, focal_px, feature.sigma_px()}),
                                     huber(), window.poses.at(key).data(), place.data());
        }
    for (auto& [id, place] : window.points) order->AddElementToGroup(place.data(), 0);
    for (auto& [key, pose] : window.poses) {
        order->AddElementToGroup(pose.data(), 1);
        if (std::find(free.begin(), free.end(), key) == free.end()) problem.SetParameterBlockConstant(pose.data());
    }
    auto solving = options(ceres::DENSE_SCHUR, most_rounds);
    solving.linear_solver_ordering.reset(order);
    ceres::Solver::Summary summary;
    ceres::Solve(solving, &problem, &summary);
    if (!summary.IsSolutionUsable()) return;
    for (const auto& [key, pose] : window.poses) map.key(key).pose = pose_of(pose);
    for (const auto& [id, place] : window.points) map.points().at(id).position = place;
    drop_wrong_sights(map, window, focal_px);
}

} // namespace locus::camera
