// What the odometry's two least squares, of a single pose and of a bundle, have in common: how a pose lies in Ceres'
// blocks, what a sight says, and how it is solved.
#pragma once

#include "drivers/camera/odometry/triangulate.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <array>

namespace locus::camera {

/// What comes to lie behind the camera on the way is very wrong, but no reason to stop.
inline constexpr double nearest = 1e-3;

/// A pose as Ceres moves it: rotation vector, then shift.
using PoseBlock = std::array<double, 6>;

inline PoseBlock block_of(const CameraPose& pose) {
    const Eigen::AngleAxisd turn(pose.camera_from_map);
    const Eigen::Vector3d vector = turn.angle() * turn.axis();
    return {vector.x(), vector.y(), vector.z(), pose.map_in_camera.x(), pose.map_in_camera.y(), pose.map_in_camera.z()};
}

inline CameraPose pose_of(const PoseBlock& block) {
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

inline ceres::LossFunction* huber() { return new ceres::HuberLoss(std::sqrt(most_off_point)); }

inline ceres::Solver::Options solver_options(ceres::LinearSolverType solver) {
    ceres::Solver::Options options;
    options.linear_solver_type = solver;
    options.dense_linear_algebra_library_type = ceres::EIGEN; // LAPACK may have threads of its own
    options.num_threads = 1;
    options.max_num_iterations = 8; // of a fit that starts where the last one ended
    options.function_tolerance = 1e-4;
    options.logging_type = ceres::SILENT;
    return options;
}

} // namespace locus::camera
