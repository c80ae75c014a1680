// How a set of points lies in space: what tells a box of anchors from a ceiling or a corridor of them.
#pragma once

#include <Eigen/Eigenvalues>

#include <cmath>

namespace locus {

template <int D>
struct Spread {
    Eigen::Matrix<double, D, 1> centroid_m;
    Eigen::Matrix<double, D, 1> normal; ///< unit vector along which the points spread least
    double thickness_m = 0;             ///< RMS along the normal
    double width_m = 0;                 ///< RMS along the next axis
    double length_m = 0;                ///< RMS along the longest axis
};

/// Principal axes of points (D x n), from the singular values of the centred points.
template <int D, class Points>
Spread<D> spread_of(const Points& points_m) {
    Spread<D> spread;
    spread.centroid_m = points_m.rowwise().mean();
    Eigen::Matrix<double, D, D> scatter = Eigen::Matrix<double, D, D>::Zero();
    for (Eigen::Index i = 0; i < points_m.cols(); ++i) {
        const Eigen::Matrix<double, D, 1> from_centroid = points_m.col(i) - spread.centroid_m;
        scatter.noalias() += from_centroid * from_centroid.transpose();
    }
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, D, D>> axes;
    axes.computeDirect(scatter / static_cast<double>(points_m.cols()));
    const Eigen::Matrix<double, D, 1> rms_m = axes.eigenvalues().cwiseMax(0).cwiseSqrt();
    spread.normal = axes.eigenvectors().col(0);
    spread.thickness_m = rms_m(0);
    spread.width_m = rms_m(1);
    spread.length_m = rms_m(D - 1);
    return spread;
}

} // namespace locus
