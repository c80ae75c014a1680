#include "fusion/uwb/survey/scaling.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace locus::uwb::survey {

Eigen::MatrixXd shortest_ways(const std::vector<PairRange>& pairs, std::size_t count) {
    const auto n = static_cast<Eigen::Index>(count);
    Eigen::MatrixXd way_m = Eigen::MatrixXd::Constant(n, n, std::numeric_limits<double>::infinity());
    way_m.diagonal().setZero();
    for (const PairRange& pair : pairs) {
        const auto a = static_cast<Eigen::Index>(pair.a), b = static_cast<Eigen::Index>(pair.b);
        way_m(a, b) = way_m(b, a) = std::min(way_m(a, b), pair.range_m);
    }
    for (Eigen::Index via = 0; via < n; ++via) // Floyd and Warshall
        for (Eigen::Index a = 0; a < n; ++a)
            for (Eigen::Index b = 0; b < n; ++b) way_m(a, b) = std::min(way_m(a, b), way_m(a, via) + way_m(via, b));
    return way_m;
}

std::vector<std::size_t> groups(const Eigen::MatrixXd& ways_m) {
    std::vector<std::size_t> lowest;
    for (Eigen::Index station = 0; station < ways_m.rows(); ++station)
        for (Eigen::Index other = 0; other <= station; ++other)
            if (std::isfinite(ways_m(station, other))) {
                lowest.push_back(static_cast<std::size_t>(other));
                break;
            }
    return lowest;
}

Positions classical_scaling(const Eigen::MatrixXd& distances_m, int dimensions) {
    const auto n = distances_m.rows();
    const Eigen::MatrixXd centre =
        Eigen::MatrixXd::Identity(n, n) - Eigen::MatrixXd::Constant(n, n, 1.0 / static_cast<double>(n));
    const Eigen::MatrixXd products = -0.5 * centre * distances_m.cwiseAbs2() * centre;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(products);
    Positions position_m = Positions::Zero(n, 3);
    for (Eigen::Index axis = 0; axis < std::min<Eigen::Index>(dimensions, n); ++axis) { // the largest values stand last
        const auto from = n - 1 - axis;
        position_m.col(axis) = std::sqrt(std::max(solver.eigenvalues()(from), 0.0)) * solver.eigenvectors().col(from);
    }
    return position_m;
}

} // namespace locus::uwb::survey
