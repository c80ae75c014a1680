#include "fusion/vision/survey/floor_fit.h"

#include "fusion/geometry/rotation.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <numbers>

namespace locus::vision::survey {
namespace {

constexpr int most_steps = 60;
constexpr double enough_step = 1e-10; // of the cost
constexpr double most_damping = 1e12;

Eigen::Matrix2d error_covariance_px2(const FloorSight& sight, const FloorPair& pair) {
    Eigen::Matrix2d covariance_px2 = pair.sigma_m * pair.sigma_m * sight.by_floor * sight.by_floor.transpose();
    covariance_px2.diagonal().array() += pair.sigma_px * pair.sigma_px;
    return covariance_px2;
}

/// With the weights of `weighed_by`, so that the costs of two views can be compared.
double cost_of(const FloorView& view, const FloorView& weighed_by, std::span<const TimedPair> pairs) {
    double cost = 0;
    for (const TimedPair& pair : pairs) {
        const auto sight = sight_of(view, pair.site_m, pair.site_m);
        const auto before = sight_of(weighed_by, pair.site_m, pair.site_m);
        if (!sight || !before) return std::numeric_limits<double>::infinity();
        const Eigen::Vector2d error_px = pair.pixel_px - sight->pixel_px;
        cost += error_px.dot(error_covariance_px2(*before, pair).inverse() * error_px);
    }
    return cost;
}

/// Marquardt's damped step.
Eigen::VectorXd step_of(const NormalEquations& normal, double damping) {
    Eigen::MatrixXd damped = normal.information;
    damped.diagonal() *= 1 + damping;
    return damped.ldlt().solve(normal.gradient);
}

} // namespace

Residual residual_of(const FloorView& view, const FloorPair& pair) noexcept {
    Residual out;
    const auto sight = sight_of(view, pair.site_m, pair.site_m);
    if (!sight) return out;
    const Eigen::Matrix2d covariance_px2 = error_covariance_px2(*sight, pair);
    out.error_px = pair.pixel_px - sight->pixel_px;
    out.test = out.error_px.dot(covariance_px2.inverse() * out.error_px);
    out.cost = out.test + std::log(covariance_px2.determinant()) + 2 * std::log(2 * std::numbers::pi);
    const auto there = foot_on_floor(view, {pair.pixel_px, Eigen::Matrix2d::Identity()});
    out.floor_m = there ? (there->position_site_m - pair.site_m).norm() : std::numeric_limits<double>::infinity();
    out.is_seen = std::isfinite(out.cost);
    return out;
}

NormalEquations normal_equations(const FloorView& view, std::span<const TimedPair> pairs,
                                 const Eigen::Vector2d& centre_m, bool with_offset) {
    const int size = view_parameters(view) + (with_offset ? 1 : 0);
    NormalEquations out{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size), 0};
    for (const TimedPair& pair : pairs) {
        const auto sight = sight_of(view, pair.site_m, centre_m);
        if (!sight) continue;
        Eigen::MatrixXd by(2, size);
        by.leftCols(view_parameters(view)) = sight->by_view;
        if (with_offset) by.col(size - 1) = sight->by_floor * pair.velocity_mps;
        const Eigen::Matrix2d weight = error_covariance_px2(*sight, pair).inverse();
        const Eigen::Vector2d error_px = pair.pixel_px - sight->pixel_px;
        out.information += by.transpose() * weight * by;
        out.gradient += by.transpose() * weight * error_px;
        out.cost += error_px.dot(weight * error_px);
    }
    return out;
}

bool is_determined(const Eigen::MatrixXd& information) {
    const Eigen::VectorXd unit = information.diagonal().cwiseSqrt();
    if (!(unit.minCoeff() > 0) || !unit.allFinite()) return false;
    const Eigen::MatrixXd scaled = unit.cwiseInverse().asDiagonal() * information * unit.cwiseInverse().asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> values(scaled, Eigen::EigenvaluesOnly);
    return values.eigenvalues()[0] > 1e-12 * values.eigenvalues()[values.eigenvalues().size() - 1];
}

Eigen::Vector2d centre_of(std::span<const TimedPair> pairs) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const TimedPair& pair : pairs) sum += pair.site_m;
    return sum / static_cast<double>(std::max<std::size_t>(pairs.size(), 1));
}

FloorFit fit_view(const FloorView& start, std::span<const TimedPair> pairs) {
    FloorFit fit{start, {}, centre_of(pairs), {}, false};
    double damping = 1e-3;
    for (int i = 0; i < most_steps && damping < most_damping; ++i) {
        const NormalEquations normal = normal_equations(fit.view, pairs, fit.centre_m, false);
        const FloorView next = moved(fit.view, step_of(normal, damping), fit.centre_m);
        const double cost = cost_of(next, fit.view, pairs);
        if (cost < normal.cost) fit.view = next;
        damping *= cost < normal.cost ? 0.1 : 10;
        if (std::abs(normal.cost - cost) <= enough_step * normal.cost) break;
    }
    const NormalEquations normal = normal_equations(fit.view, pairs, fit.centre_m, false);
    fit.is_told = is_determined(normal.information);
    fit.covariance = normal.information.inverse();
    for (const TimedPair& pair : pairs) fit.residuals.push_back(residual_of(fit.view, pair));
    return fit;
}

Eigen::Matrix2d floor_covariance_m2(const FloorFit& fit, const Eigen::Vector2d& site_m) {
    const auto sight = sight_of(fit.view, site_m, fit.centre_m);
    if (!sight) return Eigen::Matrix2d::Constant(std::numeric_limits<double>::infinity());
    const Eigen::MatrixXd by = sight->by_floor.inverse() * sight->by_view;
    return by * fit.covariance.topLeftCorner(by.cols(), by.cols()) * by.transpose();
}

Eigen::Vector3d position_sigma_m(const FloorFit& fit) {
    const auto& camera = *std::get_if<Camera>(&fit.view);
    Eigen::Matrix<double, 3, 6> by;
    by.leftCols<3>() = camera.camera_from_site.transpose() * skew(camera.site_in_camera_m);
    by.rightCols<3>() = camera.camera_from_site.transpose();
    return (by * fit.covariance.topLeftCorner<6, 6>() * by.transpose()).diagonal().cwiseSqrt();
}

} // namespace locus::vision::survey
