#include "fusion/vision/lens_models.h"

#include <cmath>
#include <numbers>

namespace locus::vision {
namespace {

Radius shown_angle(const FisheyeLens& lens, double angle) noexcept {
    const auto& k = lens.radial;
    const double square = angle * angle;
    return {angle * (1 + square * (k[0] + square * (k[1] + square * (k[2] + square * k[3])))),
            1 + square * (3 * k[0] + square * (5 * k[1] + square * (7 * k[2] + square * 9 * k[3])))};
}

bool is_within(const FisheyeLens& lens, double angle) noexcept {
    return angle <= std::numbers::pi && grows_until(angle, [&](double a) { return shown_angle(lens, a); });
}

/// The angle that is shown as `wanted`, by Newton's steps.
std::optional<double> angle_shown_as(const FisheyeLens& lens, double wanted) noexcept {
    double angle = wanted;
    for (int step = 0; step < max_newton_steps; ++step) {
        const Radius shown = shown_angle(lens, angle);
        if (std::abs(shown.shown - wanted) <= 1e-13 * (1 + wanted))
            return is_within(lens, angle) ? std::optional(angle) : std::nullopt;
        angle -= (shown.shown - wanted) / shown.growth;
    }
    return std::nullopt;
}

/// On the axis, where the direction outwards has no meaning, a fisheye is a pinhole.
Sight on_axis(const FisheyeLens& lens, const Eigen::Vector3d& ray) noexcept {
    const Sight straight = slope_of(ray);
    return {lens.focal_px.cwiseProduct(straight.pixel_px) + lens.centre_px,
            lens.focal_px.asDiagonal() * straight.by_ray};
}

} // namespace

std::optional<Sight> project_with(const FisheyeLens& lens, const Eigen::Vector3d& ray) noexcept {
    const double across = ray.head<2>().norm(), square = ray.squaredNorm();
    if (across <= 1e-9 * ray.z()) return on_axis(lens, ray);
    if (!(across > 0)) return std::nullopt;
    const double angle = std::atan2(across, ray.z());
    if (!is_within(lens, angle)) return std::nullopt;
    const Radius shown = shown_angle(lens, angle);
    const Eigen::Vector2d outwards = ray.head<2>() / across;
    const Eigen::Matrix2d outwards2 = outwards * outwards.transpose();
    Eigen::Matrix<double, 2, 3> by_ray;
    by_ray.leftCols<2>() =
        shown.shown / across * (Eigen::Matrix2d::Identity() - outwards2) + shown.growth * ray.z() / square * outwards2;
    by_ray.col(2) = -shown.growth * across / square * outwards;
    return Sight{lens.focal_px.cwiseProduct(shown.shown * outwards) + lens.centre_px,
                 lens.focal_px.asDiagonal() * by_ray};
}

std::optional<Eigen::Vector3d> unproject_with(const FisheyeLens& lens, const Eigen::Vector2d& pixel_px) noexcept {
    const Eigen::Vector2d shown = (pixel_px - lens.centre_px).cwiseQuotient(lens.focal_px);
    const double length = shown.norm();
    if (length < 1e-9) return ray_at(shown);
    const auto angle = angle_shown_as(lens, length);
    if (!angle) return std::nullopt;
    const Eigen::Vector2d across = std::sin(*angle) / length * shown;
    return Eigen::Vector3d(across.x(), across.y(), std::cos(*angle));
}

} // namespace locus::vision
