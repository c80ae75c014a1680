#include "drivers/camera/odometry/pose_fit.h"

#include "drivers/camera/odometry/reprojection.h"

namespace locus::camera {
namespace {

struct ReprojectionOfKnown {
    Reprojection reprojection;
    Eigen::Vector3d point;

    template <class T>
    bool operator()(const T* pose, T* residual) const {
        const std::array<T, 3> there{T(point.x()), T(point.y()), T(point.z())};
        return reprojection(pose, there.data(), residual);
    }
};

} // namespace

CameraPose fit_pose(const CameraPose& start, std::span<const KnownSight> sights, double focal_px) {
    PoseBlock pose = block_of(start);
    ceres::Problem problem;
    for (const auto& [point, feature] : sights)
        problem.AddResidualBlock(new ceres::AutoDiffCostFunction<ReprojectionOfKnown, 2, 6>(
                                     new ReprojectionOfKnown{{feature->at_px, focal_px, feature->sigma_px()}, point}),
                                 huber(), pose.data());
    ceres::Solver::Summary summary;
    ceres::Solve(solver_options(ceres::DENSE_NORMAL_CHOLESKY), &problem, &summary);
    return summary.IsSolutionUsable() ? pose_of(pose) : start;
}

} // namespace locus::camera
