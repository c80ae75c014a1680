// Weighted normal equations, summed row by row. Chan's two steps and the Taylor steps are both this sum, over different
// rows; noise that all rows share (one reference anchor in every difference) is a rank-one correction at the end.
#pragma once

#include "fusion/uwb/epoch.h"

#include <Eigen/Core>

namespace locus::uwb {

template <int N>
class NormalEquations {
  public:
    /// The N coefficients of an equation and, last, its residual: all divided by its standard deviation.
    using Equation = Eigen::Matrix<double, N + 1, 1>;
    /// One equation a row, of which the first `count` are there. Column by column in memory: products of columns are
    /// all that is wanted, and the processor takes those two rows at a time.
    using Equations = Eigen::Matrix<double, static_cast<int>(max_observations), N + 1, Eigen::ColMajor>;

    NormalEquations(const Equations& rows, Eigen::Index count) {
        for (int column = 0; column <= N; ++column)
            for (int i = 0; i <= column; ++i)
                squares_(i, column) = rows.col(i).head(count).dot(rows.col(column).head(count));
    }

    /// Turns independent noise into noise with one correlation c between any two of the `count` rows, whose sum is
    /// given: R = (1 - c) I + c 11', so R^-1 = (I - c / (1 - c + count c) 11') / (1 - c)   (Sherman-Morrison).
    void correlate(double correlation, double count, const Equation& sum) {
        const double scale = correlation / (1 - correlation + count * correlation);
        for (int column = 0; column <= N; ++column)
            for (int i = 0; i <= column; ++i) squares_(i, column) -= scale * sum(i) * sum(column);
        squares_ /= 1 - correlation;
    }

    /// H' R^-1 H
    Eigen::Matrix<double, N, N> information() const {
        return squares_.template topLeftCorner<N, N>().template selfadjointView<Eigen::Upper>();
    }
    /// H' R^-1 residual
    Eigen::Matrix<double, N, 1> projection() const { return squares_.template topRightCorner<N, 1>(); }
    /// residual' R^-1 residual
    double cost() const { return squares_(N, N); }

  private:
    /// Of rows, so the residuals' products are in the last column. Upper half only.
    Eigen::Matrix<double, N + 1, N + 1> squares_ = Eigen::Matrix<double, N + 1, N + 1>::Zero();
};

/// The sum over all rows of an epoch. `equation` gives the Equation of one row.
template <int N, class Equation>
NormalEquations<N> sum_of_rows(const Epoch& epoch, const Equation& equation) {
    typename NormalEquations<N>::Equations rows;
    const auto count = static_cast<Eigen::Index>(epoch.rows.size());
    for (Eigen::Index i = 0; i < count; ++i)
        rows.row(i) = equation(epoch.rows[static_cast<std::size_t>(i)]).transpose();
    NormalEquations<N> normal(rows, count);
    if (epoch.correlation > 0)
        normal.correlate(epoch.correlation, static_cast<double>(count), rows.topRows(count).colwise().sum().transpose());
    return normal;
}

} // namespace locus::uwb
