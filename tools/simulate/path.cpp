#include "tools/simulate/path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace locus::simulate {
namespace {

using Eigen::Vector3d;

constexpr int corner_steps = 16;
constexpr int eight_steps = 4096;

/// Bezier curve of second order from one side of the corner to the other.
void add_corner(std::vector<Vector3d>& curve, const Vector3d& before, const Vector3d& corner, const Vector3d& after,
                double corner_m) {
    const auto toward = [&](const Vector3d& other) -> Vector3d {
        const double length = (other - corner).norm();
        return length > 0 ? Vector3d{corner + (other - corner) * std::min(corner_m / length, 0.5)} : corner;
    };
    const Vector3d from = toward(before), to = toward(after);
    for (int i = 0; i <= corner_steps; ++i) {
        const double u = static_cast<double>(i) / corner_steps;
        curve.emplace_back((1 - u) * (1 - u) * from + 2 * u * (1 - u) * corner + u * u * to);
    }
}

} // namespace

Path::Path(std::vector<Vector3d> points) : points_(std::move(points)) {
    points_.push_back(points_.front());
    at_m_.push_back(0);
    for (std::size_t i = 1; i < points_.size(); ++i)
        at_m_.push_back(at_m_.back() + (points_[i] - points_[i - 1]).norm());
}

Path Path::through(const std::vector<Vector3d>& points, double corner_m) {
    const std::size_t count = points.size();
    std::vector<Vector3d> curve;
    for (std::size_t i = 0; i < count; ++i)
        add_corner(curve, points[(i + count - 1) % count], points[i], points[(i + 1) % count], corner_m);
    return Path(std::move(curve));
}

Path Path::figure_of_eight(const Vector3d& centre, const Vector3d& size_m) {
    std::vector<Vector3d> curve;
    for (int i = 0; i < eight_steps; ++i) {
        const double angle = 2 * std::numbers::pi * i / eight_steps;
        const Vector3d unit{std::sin(angle), std::sin(2 * angle), std::cos(angle)};
        curve.emplace_back(centre + 0.5 * size_m.cwiseProduct(unit));
    }
    return Path(std::move(curve));
}

Path::Point Path::at(double distance_m) const {
    if (length_m() <= 0) return {points_.front(), Vector3d::Zero()};
    const double along = std::fmod(distance_m, length_m());
    const double wrapped = along < 0 ? along + length_m() : along;
    const auto after = std::upper_bound(at_m_.begin() + 1, at_m_.end() - 1, wrapped);
    const auto i = static_cast<std::size_t>(after - at_m_.begin());
    const Vector3d step = points_[i] - points_[i - 1];
    const double length = at_m_[i] - at_m_[i - 1];
    if (length <= 0) return {points_[i], Vector3d::Zero()};
    return {points_[i - 1] + step * ((wrapped - at_m_[i - 1]) / length), step / length};
}

} // namespace locus::simulate
