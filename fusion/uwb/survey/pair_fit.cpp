#include "fusion/uwb/survey/pair_fit.h"

#include "fusion/filter/robust_gain.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace locus::uwb::survey {
namespace {

/// A direction whose eigenvalue is this small beside the largest is not determined at all.
constexpr double singular = 1e-12;

/// Variance of a pair's predicted distance in units of its own noise: what is left of its residual is 1 less that.
double leverage(const PairRow& row, const Eigen::MatrixXd& covariance) {
    double sum = 0;
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
            if (row.unknown[i] >= 0 && row.unknown[j] >= 0)
                sum += row.slope(static_cast<Eigen::Index>(i)) * row.slope(static_cast<Eigen::Index>(j)) *
                       covariance(row.unknown[i], row.unknown[j]);
    return sum;
}

} // namespace

Spread spread_of(const Eigen::MatrixXd& information) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(information);
    const double limit = singular * std::max(1.0, solver.eigenvalues().tail(1)(0));
    Spread spread{Eigen::MatrixXd::Zero(information.rows(), information.cols()), {}};
    Eigen::VectorXd lost = Eigen::VectorXd::Zero(information.rows());
    for (Eigen::Index i = 0; i < information.rows(); ++i) {
        const Eigen::VectorXd direction = solver.eigenvectors().col(i);
        if (solver.eigenvalues()(i) > limit)
            spread.covariance += robust_covariance_factor / solver.eigenvalues()(i) * direction * direction.transpose();
        else
            lost += direction.cwiseAbs2();
    }
    spread.sigma = spread.covariance.diagonal().cwiseSqrt();
    constexpr double noticeable = 1e-6;
    for (Eigen::Index i = 0; i < lost.size(); ++i)
        if (lost(i) > noticeable) spread.sigma(i) = std::numeric_limits<double>::infinity();
    return spread;
}

PairFit fit_of(const PairRange& pair, const Unknowns& unknowns, const Positions& at_m,
               const Eigen::MatrixXd& covariance, double scale) {
    const PairRow row = row_of(pair, unknowns, at_m);
    PairFit fit{row.residual * pair.sigma_m, filter::cauchy_weight(row.residual, scale), 0};
    const double controlled = 1 - fit.weight * leverage(row, covariance);
    constexpr double hardly = 0.02;
    if (controlled > hardly) fit.normalised = row.residual / std::sqrt(controlled);
    return fit;
}

} // namespace locus::uwb::survey
