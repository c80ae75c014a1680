#include "fusion/vision/scale/similarity_fit.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace locus::vision {
namespace {

constexpr int common_at = Similarity::size, unknowns = Similarity::size + 1;
using Vector = Eigen::Matrix<double, unknowns, 1>;
using Matrix = Eigen::Matrix<double, unknowns, unknowns>;

constexpr int most_rounds = 8;
constexpr double settled = 1e-4; ///< of the scale's logarithm, radians and metres: nobody sees less
/// Residuals beyond this count linearly, not squared (Huber 1981): 95 % of good ones lie within.
constexpr double huber_in_sigma = 2;
constexpr double least_misfit = 1; ///< less is luck: weak fits would be too sure of themselves
/// Twice as many as unknowns, so that what is left over says how large the noise is.
constexpr std::size_t least_rows = 18;
/// A round that turns or stretches by more than this is no correction.
constexpr double widest_step = 3;

struct Equations {
    Matrix matrix = Matrix::Zero();
    Vector vector = Vector::Zero();
    double squares = 0; ///< of the weighed residuals in sigma
};

/// Information of a row that lies far back on a path that drifts.
double faded(const RangeRow& row, double now_odometry, double scale, double drift_m_rtm) {
    const double since_m = scale * std::max(0.0, now_odometry - row.gone_odometry);
    return row.information_per_m2 / (1 + drift_m_rtm * drift_m_rtm * since_m * row.information_per_m2);
}

/// What is known without any measurement: a turn is none beyond half a circle, a scale hardly off by its e-fold, the
/// clocks, and what ranges have in common. So weak that only what the rows do not tell at all feels it.
void add_prior(Equations& sum, const SimilarityFit& at, const SimilarityFitSettings& settings) {
    const auto known = [](double sigma) { return 1 / std::pow(std::max(sigma, 1e-6), 2); };
    sum.matrix(Similarity::log_scale_at, Similarity::log_scale_at) += 1;
    for (int i = 0; i < 3; ++i) {
        sum.matrix(Similarity::turn_at + i, Similarity::turn_at + i) += known(std::numbers::pi);
        sum.matrix(Similarity::origin_at + i, Similarity::origin_at + i) += known(1e3);
    }
    const double offset = known(settings.time_offset_sigma_s), common = known(settings.common_range_sigma_m);
    sum.matrix(Similarity::offset_at, Similarity::offset_at) += offset;
    sum.vector(Similarity::offset_at) -= offset * at.similarity.offset_s;
    sum.matrix(common_at, common_at) += common;
    sum.vector(common_at) -= common * at.common_range_m;
}

struct Residual {
    double value_m = 0;
    Vector jacobian; ///< of what is expected
};

Residual residual_of(const RangeRow& row, const Site& site, const SimilarityFit& at) {
    const Eigen::Vector3d place_m = at.similarity.place_site_m(row.position_odometry, row.velocity_odometry_per_s);
    const bool range = !row.is_height() && row.sighting.is_range();
    Residual residual;
    Eigen::Vector3d gradient = Eigen::Vector3d::UnitZ();
    double expected_m = place_m.z();
    if (!row.is_height()) {
        gradient = uwb::gradient(row.sighting, site, place_m);
        expected_m = uwb::predicted_m(row.sighting, site, place_m) + (range ? at.common_range_m : 0);
    }
    residual.value_m = row.sighting.value_m - expected_m;
    const Similarity::Jacobian by = at.similarity.jacobian(row.position_odometry, row.velocity_odometry_per_s);
    residual.jacobian.head<Similarity::size>() = by.transpose().lazyProduct(gradient);
    residual.jacobian(common_at) = range ? 1 : 0;
    return residual;
}

Equations equations_of(std::span<const RangeRow> rows, const Site& site, const SimilarityFit& at,
                       const SimilarityFitSettings& settings) {
    Equations sum;
    for (const RangeRow& row : rows) {
        const double information = faded(row, rows.back().gone_odometry, at.similarity.scale(), settings.drift_m_rtm);
        const Residual residual = residual_of(row, site, at);
        const double in_sigma = std::abs(residual.value_m) * std::sqrt(information);
        const double weight = std::min(1.0, huber_in_sigma / std::max(in_sigma, 1e-9));
        const Vector weighed = weight * information * residual.jacobian;
        sum.matrix.noalias() += weighed.lazyProduct(residual.jacobian.transpose());
        sum.vector += weighed * residual.value_m;
        sum.squares += weight * in_sigma * in_sigma;
    }
    add_prior(sum, at, settings);
    return sum;
}

} // namespace

Eigen::Matrix3d SimilarityFit::place_covariance_m2(const Eigen::Vector3d& position_odometry,
                                                   const Eigen::Vector3d& velocity_odometry_per_s) const {
    const Similarity::Jacobian by = similarity.jacobian(position_odometry, velocity_odometry_per_s);
    const Similarity::Jacobian spread = by.lazyProduct(covariance);
    return spread.lazyProduct(by.transpose());
}

std::optional<SimilarityFit> fit_similarity(const SimilarityFit& start, std::span<const RangeRow> rows,
                                            const Site& site, const SimilarityFitSettings& settings) noexcept {
    if (rows.size() < least_rows) return {};
    SimilarityFit fit = start;
    Equations sum = equations_of(rows, site, fit, settings);
    for (int round = 0; round < most_rounds; ++round) {
        const Vector step = sum.matrix.ldlt().solve(sum.vector);
        if (!step.allFinite() || step.head<4>().norm() > widest_step) return {};
        fit.similarity.move_by(step.head<Similarity::size>());
        fit.common_range_m += step(common_at);
        sum = equations_of(rows, site, fit, settings);
        if (step.head<7>().norm() < settled) break;
    }
    fit.misfit =
        std::max(least_misfit, sum.squares / static_cast<double>(rows.size() - static_cast<std::size_t>(unknowns)));
    const Matrix covariance = fit.misfit * sum.matrix.inverse();
    fit.covariance = covariance.topLeftCorner<Similarity::size, Similarity::size>();
    if (!fit.covariance.allFinite()) return {};
    return fit;
}

} // namespace locus::vision
