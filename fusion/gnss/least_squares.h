// Weighted least squares of a few unknowns with the tests that belong to it: whether the residuals are no larger than
// chance makes them (chi-square, all of them) and which one sticks out most (Baarda, A testing procedure for use in
// geodetic networks, 1968: each over its own standard deviation).
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <cmath>

namespace locus::gnss {

/// Quantile of chi-square by Wilson and Hilferty (1931): at 1 in 1000 3 % too wide with one degree of freedom, 1 % with
/// five. `normal_quantile`: of the same probability.
inline double chi_square_limit(int degrees_of_freedom, double normal_quantile) {
    const double d = degrees_of_freedom, spread = 2 / (9 * d);
    return d * std::pow(1 - spread + normal_quantile * std::sqrt(spread), 3);
}

template <int N>
class LeastSquares {
  public:
    using Row = Eigen::Matrix<double, N, 1>;

    void add(const Row& row, double residual, double variance) {
        information_.noalias() += row * (row / variance).transpose();
        projection_ += row * (residual / variance);
        cost_ += residual * residual / variance;
        ++rows_;
    }

    /// An unknown that no row has: it stays what it is, and no row pays for it.
    void hold(int unknown) {
        information_(unknown, unknown) = 1;
        ++held_;
    }

    /// False when the unknowns do not follow from the rows.
    bool solve() {
        const Eigen::LLT<Eigen::Matrix<double, N, N>> cholesky(information_);
        if (cholesky.info() != Eigen::Success) return false;
        covariance_ = cholesky.solve(Eigen::Matrix<double, N, N>::Identity());
        step_ = covariance_ * projection_;
        return step_.allFinite() && covariance_.allFinite();
    }

    const Row& step() const { return step_; }
    const Eigen::Matrix<double, N, N>& covariance() const { return covariance_; }
    int redundancy() const { return rows_ - (N - held_); }

    /// Sum of the squared residuals after the step, each over its variance.
    double cost_after() const { return std::max(0.0, cost_ - projection_.dot(step_)); }

    /// A residual after the step over its own standard deviation; 0 where nothing checks that row.
    double outlying(const Row& row, double residual, double variance) const {
        constexpr double least_checked = 1e-6;
        const double checked = 1 - row.dot(covariance_ * row) / variance;
        return checked > least_checked ? std::abs(residual - row.dot(step_)) / std::sqrt(variance * checked) : 0;
    }

  private:
    Eigen::Matrix<double, N, N> information_ = Eigen::Matrix<double, N, N>::Zero(), covariance_;
    Row projection_ = Row::Zero(), step_;
    double cost_ = 0;
    int rows_ = 0, held_ = 0;
};

/// Whether the residuals together are no larger than chance makes them.
template <int N>
bool agree(const LeastSquares<N>& equations, double normal_quantile) {
    return equations.redundancy() < 1 ||
           equations.cost_after() <= chi_square_limit(equations.redundancy(), normal_quantile);
}

/// With one observation too many it shows that one is wrong, but not which. With two it shows which, if there is only
/// one: between high houses there are more, and of six satellites five often agree by chance on a wrong place.
template <int N>
bool tells_which(const LeastSquares<N>& equations) {
    return equations.redundancy() >= 3;
}

} // namespace locus::gnss
