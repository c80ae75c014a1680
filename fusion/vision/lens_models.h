// The lenses one by one, for lens.cpp, which asks the one that a camera has.
#pragma once

#include "fusion/vision/lens.h"

namespace locus::vision {

std::optional<Sight> project_with(const PinholeLens& lens, const Eigen::Vector3d& ray) noexcept;
std::optional<Sight> project_with(const FisheyeLens& lens, const Eigen::Vector3d& ray) noexcept;
std::optional<Sight> project_with(const TsaiLens& lens, const Eigen::Vector3d& ray) noexcept;

/// Of any length.
std::optional<Eigen::Vector3d> unproject_with(const PinholeLens& lens, const Eigen::Vector2d& pixel_px) noexcept;
std::optional<Eigen::Vector3d> unproject_with(const FisheyeLens& lens, const Eigen::Vector2d& pixel_px) noexcept;
std::optional<Eigen::Vector3d> unproject_with(const TsaiLens& lens, const Eigen::Vector2d& pixel_px) noexcept;

/// A distance from the axis as a lens shows it, and how it grows with the true one.
struct Radius {
    double shown = 0;
    double growth = 0;
};

inline constexpr int max_newton_steps = 50;

/// Whether what is shown grows all the way from the axis to `distance`, at 32 places of it.
template <class Curve>
bool grows_until(double distance, const Curve& curve) noexcept {
    for (int i = 1; i <= 32; ++i)
        if (!(curve(distance * i / 32).growth > 0)) return false;
    return true;
}

/// The pair (x / z, y / z) of a ray and its derivative.
inline Sight slope_of(const Eigen::Vector3d& ray) noexcept {
    Sight slope;
    slope.pixel_px = ray.head<2>() / ray.z();
    slope.by_ray << 1, 0, -slope.pixel_px.x(), 0, 1, -slope.pixel_px.y();
    slope.by_ray /= ray.z();
    return slope;
}

inline std::optional<Eigen::Vector3d> ray_at(const Eigen::Vector2d& slope) noexcept {
    return Eigen::Vector3d(slope.x(), slope.y(), 1);
}

} // namespace locus::vision
