#include "fusion/vision/extent.h"

#include "fusion/filter/scalar_update.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace locus::vision {
namespace {

constexpr double smallest_px = 1;

} // namespace

Extent::Extent(const Edges& edges_px, double anchor, double edge_variance_px2, double start_variance_px2ps2) noexcept
    : anchor_(anchor),
      state_((1 - anchor) * edges_px(0) + anchor * edges_px(1), 0, std::max(edges_px(1) - edges_px(0), smallest_px)) {
    const Eigen::Matrix2d from_edges = (Eigen::Matrix2d() << 1 - anchor, anchor, -1, 1).finished();
    const Eigen::Matrix2d started = edge_variance_px2 * from_edges * from_edges.transpose();
    covariance_.row(0) << started(0, 0), 0, started(0, 1);
    covariance_.row(1) << 0, start_variance_px2ps2, 0;
    covariance_.row(2) << started(1, 0), 0, started(1, 1);
}

void Extent::predict(double dt_s, double acceleration_density, double wander_density) noexcept {
    const double q = acceleration_density, t = dt_s;
    Eigen::Matrix3d move = Eigen::Matrix3d::Identity();
    move(0, 1) = t;
    Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();
    noise.topLeftCorner<2, 2>() << q * t * t * t / 3, q * t * t / 2, q * t * t / 2, q * t;
    noise(2, 2) = wander_density * t;
    state_(0) += state_(1) * t;
    covariance_ = (move * covariance_ * move.transpose()).eval() + noise;
}

void Extent::update(const Edges& measured_px, double edge_variance_px2) noexcept {
    take_in(higher_row(), measured_px(1), edge_variance_px2);
    update_lower(measured_px(0), edge_variance_px2);
}

void Extent::update_lower(double measured_px, double edge_variance_px2) noexcept {
    take_in(lower_row(), measured_px, edge_variance_px2);
    state_(2) = std::max(state_(2), smallest_px);
}

double Extent::lower_variance_px2() const noexcept { return lower_row().dot(covariance_ * lower_row()); }

Extent::Distance Extent::distance(const Edges& measured_px, double edge_variance_px2) const noexcept {
    Eigen::Matrix<double, 2, 3> rows;
    rows << lower_row().transpose(), higher_row().transpose();
    const Edges innovation = measured_px - rows * state_;
    const Eigen::Matrix2d spread =
        rows * covariance_ * rows.transpose() + edge_variance_px2 * Eigen::Matrix2d::Identity();
    return {innovation.dot(spread.inverse() * innovation),
            std::log(spread.determinant() / (edge_variance_px2 * edge_variance_px2))};
}

void Extent::take_in(const Row& row, double measured_px, double variance_px2) noexcept {
    const auto prediction = filter::predict_scalar(covariance_, row);
    filter::update_scalar(state_, covariance_, prediction, measured_px - row.dot(state_), variance_px2);
}

} // namespace locus::vision
