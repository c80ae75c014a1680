#include "tools/simulate/world.h"

#include "fusion/geometry/vector.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace locus::simulate {
namespace {

using Eigen::Vector3d;

constexpr double step_m = 0.7; // of a person walking

Path make_path(const Motion& motion) {
    if (motion.path == "figure_of_eight")
        return Path::figure_of_eight(vector(motion.center_site_m), vector(motion.size_m));
    std::vector<Vector3d> points;
    for (const Vec3& point : motion.waypoints_site_m) points.push_back(vector(point));
    return Path::through(points, motion.corner_m);
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

} // namespace

Target::Target(const Motion& motion)
    : path_(make_path(motion)), speed_mps_(motion.speed_mps), sway_m_(motion.sway_m), start_m_(motion.start_m) {}

TruePose Target::at(double time_s) const {
    const double walked_m = start_m_ + speed_mps_ * time_s;
    const auto [position, direction] = path_.at(walked_m);
    // The body rises with every step, and goes left and right once in two.
    const double phase = 2 * std::numbers::pi * walked_m / step_m;
    const Vector3d left = Vector3d::UnitZ().cross(direction);
    const Vector3d sway = sway_m_ * (std::sin(phase) * Vector3d::UnitZ() + std::sin(phase / 2) * left);
    return {position + sway, std::atan2(direction.y(), direction.x())};
}

bool crosses(const Wall& wall, const Vector3d& a_site_m, const Vector3d& b_site_m) {
    const Vector3d from = vector(wall.from_site_m), to = vector(wall.to_site_m);
    const Eigen::Vector2d along = (to - from).head<2>(), ray = (b_site_m - a_site_m).head<2>();
    const Eigen::Vector2d gap = (from - a_site_m).head<2>();
    const double turn = cross(ray, along);
    if (turn == 0) return false; // the ray runs beside the wall, or straight up
    const double on_ray = cross(gap, along) / turn, on_wall = cross(gap, ray) / turn;
    if (on_ray < 0 || on_ray > 1 || on_wall < 0 || on_wall > 1) return false;
    const double height_m = a_site_m.z() + on_ray * (b_site_m.z() - a_site_m.z());
    return height_m >= std::min(from.z(), to.z()) && height_m <= std::max(from.z(), to.z());
}

} // namespace locus::simulate
