// Weighted normal equations, summed row by row. Chan's two steps and the Taylor steps are both this sum, over different
// rows; noise that all rows share (one reference anchor in every difference) is a rank-one correction at the end.
#pragma once

#include "fusion/uwb/epoch.h"

#include <Eigen/Core>

namespace locus::uwb {

template <int N>
class NormalEquations {
  public:
    using Equation = Eigen::Matrix<double, N + 1, 1>;

    /// The N coefficients of an equation and, last, its residual: all divided by its standard deviation.
    void add(const Equation& row) {
        for (int column = 0; column <= N; ++column) squares_.col(column) += row(column) * row;
    }

    /// Turns independent noise into noise with one correlation c between any two of the `count` rows, whose sum is
    /// given: R = (1 - c) I + c 11', so R^-1 = (I - c / (1 - c + count c) 11') / (1 - c)   (Sherman-Morrison).
    void correlate(double correlation, double count, const Equation& sum) {
        squares_.noalias() -= correlation / (1 - correlation + count * correlation) * sum * sum.transpose();
        squares_ /= 1 - correlation;
    }

    /// H' R^-1 H
    Eigen::Matrix<double, N, N> information() const { return squares_.template topLeftCorner<N, N>(); }
    /// H' R^-1 residual
    Eigen::Matrix<double, N, 1> projection() const { return squares_.template topRightCorner<N, 1>(); }
    /// residual' R^-1 residual
    double cost() const { return squares_(N, N); }

  private:
    /// Of rows, so the residuals' products are in the last column.
    Eigen::Matrix<double, N + 1, N + 1> squares_ = Eigen::Matrix<double, N + 1, N + 1>::Zero();
};

/// The sum over all rows of an epoch. `equation` gives what add() takes, for one row.
template <int N, class Equation>
NormalEquations<N> sum_of_rows(const Epoch& epoch, const Equation& equation) {
    NormalEquations<N> normal;
    for (const Row& row : epoch.rows) normal.add(equation(row));
    if (epoch.correlation > 0) {
        typename NormalEquations<N>::Equation sum = NormalEquations<N>::Equation::Zero();
        for (const Row& row : epoch.rows) sum += equation(row);
        normal.correlate(epoch.correlation, static_cast<double>(epoch.rows.size()), sum);
    }
    return normal;
}

} // namespace locus::uwb
