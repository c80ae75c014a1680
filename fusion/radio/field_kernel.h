// The Gaussian process of a map's strengths: what is asked of every point pair and every source. Strength at a place is
// level - exponent * 10 log10(distance to the source), a deviation that neighbouring places share (Matern 3/2;
// Rasmussen and Williams 2006, eq. 4.17), and one that they do not: fading within a step, noise.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <cmath>
#include <numbers>

namespace locus::radio {

/// Rows are points on the floor, m.
using FloorPoints = Eigen::Matrix<double, Eigen::Dynamic, 2>;
/// Rows are (1, -10 log10 distance): what level and exponent are multiplied with.
using LossBasis = Eigen::Matrix<double, Eigen::Dynamic, 2>;

struct FieldHypothesis {
    double length_m = 1; ///< over which places share their deviation
    double shared_db = 1;
    double own_db = 1;
};

inline double alike(double distance_m, double length_m) {
    const double lengths = std::numbers::sqrt3 * distance_m / length_m;
    return (1 + lengths) * std::exp(-lengths);
}

inline Eigen::MatrixXd shared_covariance(const FloorPoints& a, const FloorPoints& b, const FieldHypothesis& h) {
    Eigen::MatrixXd shared(a.rows(), b.rows());
    for (Eigen::Index j = 0; j < b.rows(); ++j)
        for (Eigen::Index i = 0; i < a.rows(); ++i)
            shared(i, j) = h.shared_db * h.shared_db * alike((a.row(i) - b.row(j)).norm(), h.length_m);
    return shared;
}

/// Nobody stands nearer to a beacon than about a metre, the distance that path-loss models begin at.
inline LossBasis loss_basis(const FloorPoints& points, const Eigen::Vector2d& source_m) {
    LossBasis basis(points.rows(), 2);
    for (Eigen::Index i = 0; i < points.rows(); ++i)
        basis.row(i) << 1, -5 * std::log10(1 + (points.row(i).transpose() - source_m).squaredNorm());
    return basis;
}

/// What is known of level and exponent before any map: nothing of the level; 2 in free space, 1.6 to 3.3 indoors
/// (Rappaport, table 4.2).
struct LossPrior {
    Eigen::Vector2d mean{-60, 2};
    Eigen::Vector2d information{1e-4, 1};
};

} // namespace locus::radio
