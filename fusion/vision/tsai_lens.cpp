// Tsai's polynomial goes from the distorted point to the straight one: a pixel's ray is a formula, and a ray's pixel is
// the root of a cubic.
#include "fusion/vision/lens_models.h"

#include <cmath>

namespace locus::vision {
namespace {

Radius straight_radius(const TsaiLens& lens, double distorted_mm) noexcept {
    const double bent = lens.kappa1_per_mm2 * distorted_mm * distorted_mm;
    return {distorted_mm * (1 + bent), 1 + 3 * bent};
}

/// Newton from the straight radius: of a cubic that bends one way it stays on one side of the root.
std::optional<double> distorted_radius(const TsaiLens& lens, double straight_mm) noexcept {
    double distorted_mm = straight_mm;
    for (int step = 0; step < max_newton_steps; ++step) {
        const Radius straight = straight_radius(lens, distorted_mm);
        if (!(straight.growth > 0)) return std::nullopt;
        const double error_mm = straight.shown - straight_mm;
        if (std::abs(error_mm) <= 1e-13 * (1 + straight_mm)) return distorted_mm;
        distorted_mm -= error_mm / straight.growth;
    }
    return std::nullopt;
}

} // namespace

std::optional<Sight> project_with(const TsaiLens& lens, const Eigen::Vector3d& ray) noexcept {
    if (!(ray.z() > 0)) return std::nullopt;
    const Sight straight = slope_of(ray);
    const double straight_mm = lens.focal_mm * straight.pixel_px.norm();
    const auto distorted_mm = distorted_radius(lens, straight_mm);
    if (!distorted_mm) return std::nullopt;
    const double shrink = straight_mm > 0 ? *distorted_mm / straight_mm : 1;
    const double growth = 1 / straight_radius(lens, *distorted_mm).growth;
    const Eigen::Vector2d outwards = straight.pixel_px.stableNormalized();
    Eigen::Matrix2d bend = (growth - shrink) * outwards * outwards.transpose();
    bend.diagonal().array() += shrink;
    const Eigen::Vector2d focal_px = lens.focal_mm * lens.pitch_mm.cwiseInverse();
    return Sight{shrink * focal_px.cwiseProduct(straight.pixel_px) + lens.centre_px,
                 focal_px.asDiagonal() * bend * straight.by_ray};
}

std::optional<Eigen::Vector3d> unproject_with(const TsaiLens& lens, const Eigen::Vector2d& pixel_px) noexcept {
    const Eigen::Vector2d distorted_mm = (pixel_px - lens.centre_px).cwiseProduct(lens.pitch_mm);
    const Radius straight = straight_radius(lens, distorted_mm.norm());
    if (!(straight.growth > 0)) return std::nullopt;
    const double stretch = 1 + lens.kappa1_per_mm2 * distorted_mm.squaredNorm();
    return ray_at(stretch / lens.focal_mm * distorted_mm);
}

} // namespace locus::vision
