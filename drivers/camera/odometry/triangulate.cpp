#include "drivers/camera/odometry/triangulate.h"

#include <Eigen/Eigenvalues>

#include <limits>

namespace locus::camera {
namespace {

/// Rows of the homogeneous system (Hartley and Zisserman, section 12.2).
void put_rows(Eigen::Matrix4d& system, int row, const SightLine& sight, double focal_px) {
    Eigen::Matrix<double, 3, 4> projection;
    projection << sight.pose.camera_from_map.toRotationMatrix(), sight.pose.map_in_camera;
    const Eigen::Vector2d slope = sight.feature.at_px / focal_px;
    system.row(row) = slope.x() * projection.row(2) - projection.row(0);
    system.row(row + 1) = slope.y() * projection.row(2) - projection.row(1);
}

} // namespace

double misfit(const Eigen::Vector3d& point_map, const SightLine& sight, double focal_px) {
    const Eigen::Vector3d seen = sight.pose.to_camera(point_map);
    if (!(seen.z() > 0)) return std::numeric_limits<double>::infinity();
    const double sigma_px = sight.feature.sigma_px();
    return (focal_px * seen.hnormalized() - sight.feature.at_px).squaredNorm() / (sigma_px * sigma_px);
}

double parallax_rad(const Eigen::Vector3d& point, const Eigen::Vector3d& from_a, const Eigen::Vector3d& from_b) {
    const Eigen::Vector3d a = from_a - point, b = from_b - point;
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::optional<Eigen::Vector3d> triangulate(const SightLine& a, const SightLine& b, double focal_px,
                                           double least_parallax_rad) {
    Eigen::Matrix4d system;
    put_rows(system, 0, a, focal_px);
    put_rows(system, 2, b, focal_px);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(system.transpose() * system);
    const Eigen::Vector4d point = solver.eigenvectors().col(0);
    Eigen::Vector3d place = point.hnormalized();
    if (!place.allFinite()) return std::nullopt;
    if (!(parallax_rad(place, a.pose.centre(), b.pose.centre()) > least_parallax_rad)) return std::nullopt;
    if (!(misfit(place, a, focal_px) < most_off_point && misfit(place, b, focal_px) < most_off_point))
        return std::nullopt;
    return place;
}

} // namespace locus::camera
