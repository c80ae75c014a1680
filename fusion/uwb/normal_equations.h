// Weighted normal equations, summed row by row. Chan's two steps and the Taylor steps are both this sum, over different
// rows; noise that all rows share (one reference anchor in every difference) is a rank-one correction at the end.
#pragma once

#include <Eigen/Core>

namespace locus::uwb {

template <int N>
struct NormalEquations {
    Eigen::Matrix<double, N, N> information = Eigen::Matrix<double, N, N>::Zero(); ///< H' R^-1 H
    Eigen::Matrix<double, N, 1> projection = Eigen::Matrix<double, N, 1>::Zero();  ///< H' R^-1 residual
    double cost = 0;                                                               ///< residual' R^-1 residual
    Eigen::Matrix<double, N, 1> row_sum = Eigen::Matrix<double, N, 1>::Zero();
    double residual_sum = 0;

    /// One row and its residual, both already divided by the row's standard deviation.
    void add(const Eigen::Matrix<double, N, 1>& row, double residual) {
        information.noalias() += row * row.transpose();
        projection += residual * row;
        cost += residual * residual;
        row_sum += row;
        residual_sum += residual;
    }

    /// Turns independent noise into noise with one correlation between any two of the `count` rows:
    /// R = (1 - c) I + c 11', so R^-1 = (I - c / (1 - c + count c) 11') / (1 - c)   (Sherman-Morrison).
    void correlate(double correlation, double count) {
        const double shared = correlation / (1 - correlation + count * correlation);
        information = (information - shared * row_sum * row_sum.transpose()) / (1 - correlation);
        projection = (projection - shared * residual_sum * row_sum) / (1 - correlation);
        cost = (cost - shared * residual_sum * residual_sum) / (1 - correlation);
    }
};

} // namespace locus::uwb
