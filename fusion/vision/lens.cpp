#include "fusion/vision/lens.h"

#include "fusion/vision/lens_models.h"

namespace locus::vision {
namespace {

Lens scaled_lens(TsaiLens lens, const Eigen::Vector2d& factor) noexcept {
    lens.pitch_mm = lens.pitch_mm.cwiseQuotient(factor);
    lens.centre_px = lens.centre_px.cwiseProduct(factor);
    return lens;
}

template <class Model>
Lens scaled_lens(Model lens, const Eigen::Vector2d& factor) noexcept {
    lens.focal_px = lens.focal_px.cwiseProduct(factor);
    lens.centre_px = lens.centre_px.cwiseProduct(factor);
    return lens;
}

} // namespace

// NOLINTBEGIN(bugprone-exception-escape): all alternatives are trivial, so the variant never loses its value
std::optional<Sight> project(const Lens& lens, const Eigen::Vector3d& ray) noexcept {
    const auto sight = std::visit([&](const auto& model) { return project_with(model, ray); }, lens);
    return sight && sight->pixel_px.allFinite() && sight->by_ray.allFinite() ? sight : std::nullopt;
}

std::optional<Eigen::Vector3d> unproject(const Lens& lens, const Eigen::Vector2d& pixel_px) noexcept {
    auto ray = std::visit([&](const auto& model) { return unproject_with(model, pixel_px); }, lens);
    if (!ray || !ray->allFinite()) return std::nullopt;
    ray->normalize();
    return ray;
}

Lens scaled(const Lens& lens, const Eigen::Vector2d& factor) noexcept {
    return std::visit([&](const auto& model) { return scaled_lens(model, factor); }, lens);
}
// NOLINTEND(bugprone-exception-escape)

} // namespace locus::vision
