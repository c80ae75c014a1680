#include "fusion/vision/lens_models.h"

#include <Eigen/LU>

#include <cmath>

namespace locus::vision {
namespace {

/// The radial factor at a squared distance from the axis, and its derivative by that square.
struct RadialFactor {
    double value = 1;
    double slope = 0;
};

RadialFactor radial_factor(const PinholeLens& lens, double square) noexcept {
    const auto& k = lens.radial;
    const double above = 1 + square * (k[0] + square * (k[1] + square * k[2]));
    const double below = 1 + square * (k[3] + square * (k[4] + square * k[5]));
    const double above_slope = k[0] + square * (2 * k[1] + square * 3 * k[2]);
    const double below_slope = k[3] + square * (2 * k[4] + square * 3 * k[5]);
    return {above / below, (above_slope * below - above * below_slope) / (below * below)};
}

Radius shown_slope(const PinholeLens& lens, double slope) noexcept {
    const RadialFactor factor = radial_factor(lens, slope * slope);
    return {slope * factor.value, factor.value + 2 * slope * slope * factor.slope};
}

/// A slope as it lies on the image plane at distance one, after distortion, and the derivative of that by the slope.
struct Distorted {
    Eigen::Vector2d slope;
    Eigen::Matrix2d by_slope;
};

Distorted distort(const PinholeLens& lens, const Eigen::Vector2d& slope) noexcept {
    const double x = slope.x(), y = slope.y(), square = slope.squaredNorm();
    const auto [p1, p2] = lens.tangential;
    const RadialFactor factor = radial_factor(lens, square);
    Distorted out;
    out.slope = factor.value * slope;
    out.slope +=
        Eigen::Vector2d(2 * p1 * x * y + p2 * (square + 2 * x * x), p1 * (square + 2 * y * y) + 2 * p2 * x * y);
    const double mixed = 2 * x * y * factor.slope + 2 * p1 * x + 2 * p2 * y;
    out.by_slope << factor.value + 2 * x * x * factor.slope + 2 * p1 * y + 6 * p2 * x, mixed, mixed,
        factor.value + 2 * y * y * factor.slope + 6 * p1 * y + 2 * p2 * x;
    return out;
}

bool is_within(const PinholeLens& lens, const Eigen::Vector2d& slope) noexcept {
    return grows_until(slope.norm(), [&](double r) { return shown_slope(lens, r); });
}

} // namespace

std::optional<Sight> project_with(const PinholeLens& lens, const Eigen::Vector3d& ray) noexcept {
    if (!(ray.z() > 0)) return std::nullopt;
    const Sight straight = slope_of(ray);
    if (!is_within(lens, straight.pixel_px)) return std::nullopt;
    const Distorted distorted = distort(lens, straight.pixel_px);
    return Sight{lens.focal_px.cwiseProduct(distorted.slope) + lens.centre_px,
                 lens.focal_px.asDiagonal() * distorted.by_slope * straight.by_ray};
}

std::optional<Eigen::Vector3d> unproject_with(const PinholeLens& lens, const Eigen::Vector2d& pixel_px) noexcept {
    const Eigen::Vector2d wanted = (pixel_px - lens.centre_px).cwiseQuotient(lens.focal_px);
    const double enough = 1e-12 * (1 + wanted.norm());
    Eigen::Vector2d slope = wanted;
    for (int step = 0; step < max_newton_steps; ++step) {
        const Distorted distorted = distort(lens, slope);
        const Eigen::Vector2d error = distorted.slope - wanted;
        if (error.norm() <= enough) return is_within(lens, slope) ? ray_at(slope) : std::nullopt;
        slope -= distorted.by_slope.inverse() * error;
    }
    return std::nullopt;
}

} // namespace locus::vision
