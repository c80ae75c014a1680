// How a set of points lies in space: what tells a box of anchors from a ceiling or a corridor of them.
#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace locus {

template <int D>
struct Spread {
    Eigen::Matrix<double, D, 1> centroid_m;
    Eigen::Matrix<double, D, 1> normal; ///< unit vector along which the points spread least
    double extent_m = 0;                ///< RMS distance from the centroid
    double thickness_m = 0;             ///< RMS along the normal: the smallest singular value
    double width_share = 0;             ///< two larger singular values' geometric mean over the extent: 0 on a line
};

/// Adjugate of a symmetric matrix: the inverse times the determinant, and there also when the inverse is not.
inline Eigen::Matrix2d adjugate(const Eigen::Matrix2d& m) {
    return (Eigen::Matrix2d() << m(1, 1), -m(0, 1), -m(1, 0), m(0, 0)).finished();
}
inline Eigen::Matrix3d adjugate(const Eigen::Matrix3d& m) {
    Eigen::Matrix3d result;
    for (int i = 0; i < 3; ++i) result.col(i) = m.col((i + 1) % 3).cross(m.col((i + 2) % 3));
    return result;
}

/// Of points (D x n). The adjugate of their scatter matrix grows along the thinnest axis by the product of the other
/// eigenvalues, so its largest column shows the normal without an eigenvalue solver, exactly where the points are flat.
template <int D, class Points>
Spread<D> spread_of(const Points& points_m) {
    using Matrix = Eigen::Matrix<double, D, D>;
    // A column for each coordinate: sums over points then run along memory, two points at a time.
    Eigen::Matrix<double, Eigen::Dynamic, D, Eigen::ColMajor, Points::MaxColsAtCompileTime, D> places_m =
        points_m.transpose();
    const double share = 1 / static_cast<double>(points_m.cols());
    Spread<D> spread;
    for (int i = 0; i < D; ++i) {
        spread.centroid_m(i) = share * places_m.col(i).sum();
        places_m.col(i).array() -= spread.centroid_m(i);
    }
    Matrix scatter_m2;
    for (int i = 0; i < D; ++i)
        for (int j = 0; j <= i; ++j) scatter_m2(i, j) = scatter_m2(j, i) = share * places_m.col(i).dot(places_m.col(j));
    const double square_m2 = scatter_m2.trace();
    const Matrix across = adjugate(Matrix(scatter_m2 * (1 / square_m2)));
    const Matrix sharper = across * across; // once more: the normal stands out by the square
    Eigen::Index largest = 0;
    sharper.diagonal().maxCoeff(&largest);
    spread.normal = sharper.col(largest).normalized();
    spread.extent_m = std::sqrt(square_m2);
    spread.thickness_m = std::sqrt(std::max(0.0, spread.normal.dot(scatter_m2 * spread.normal)));
    spread.width_share = std::sqrt(std::max(0.0, across.trace()));
    return spread;
}

} // namespace locus
