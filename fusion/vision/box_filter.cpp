#include "fusion/vision/box_filter.h"

namespace locus::vision {
namespace {

constexpr double in_the_middle = 0.5;
constexpr double at_the_bottom = 1;

double square_of(double value) noexcept { return value * value; }

Extent::Edges sides_of(const BoxPx& box) noexcept { return {box.left_px, box.right_px()}; }
Extent::Edges ends_of(const BoxPx& box) noexcept { return {box.top_px, box.bottom_px()}; }

Extent started(const Extent::Edges& edges_px, double anchor, double height_px, const BoxNoise& noise) noexcept {
    return {edges_px, anchor, square_of(noise.edge * height_px), square_of(noise.start_speed * height_px)};
}

} // namespace

BoxFilter::BoxFilter(const BoxPx& box, const BoxNoise& noise) noexcept
    : noise_(noise), horizontal_(started(sides_of(box), in_the_middle, box.height_px, noise)),
      vertical_(started(ends_of(box), at_the_bottom, box.height_px, noise)) {}

void BoxFilter::predict(double dt_s) noexcept {
    const double push = square_of(noise_.acceleration * height_px());
    const double wander = square_of(noise_.size_change * height_px());
    horizontal_.predict(dt_s, push, wander);
    vertical_.predict(dt_s, push, wander);
}

void BoxFilter::update(const BoxPx& box) noexcept {
    const double variance_px2 = edge_variance_px2();
    horizontal_.update(sides_of(box), variance_px2);
    vertical_.update(ends_of(box), variance_px2);
}

void BoxFilter::update_without_feet(const BoxPx& box) noexcept {
    const double variance_px2 = edge_variance_px2();
    horizontal_.update(sides_of(box), variance_px2);
    vertical_.update_lower(box.top_px, variance_px2);
}

BoxPx BoxFilter::box() const noexcept {
    return {static_cast<float>(horizontal_.lower_px()), static_cast<float>(vertical_.lower_px()),
            static_cast<float>(horizontal_.size_px()), static_cast<float>(vertical_.size_px())};
}

Eigen::Matrix2d BoxFilter::foot_covariance_px2() const noexcept {
    return Eigen::Vector2d(horizontal_.place_variance_px2(), vertical_.place_variance_px2()).asDiagonal();
}

Eigen::Matrix2d BoxFilter::head_covariance_px2() const noexcept {
    return Eigen::Vector2d(horizontal_.place_variance_px2(), vertical_.lower_variance_px2()).asDiagonal();
}

Extent::Distance BoxFilter::distance(const BoxPx& box) const noexcept {
    const auto across = horizontal_.distance(sides_of(box), edge_variance_px2());
    const auto upright = vertical_.distance(ends_of(box), edge_variance_px2());
    return {across.mahalanobis2 + upright.mahalanobis2, across.log_doubt + upright.log_doubt};
}

double BoxFilter::edge_variance_px2() const noexcept { return square_of(noise_.edge * height_px()); }

} // namespace locus::vision
