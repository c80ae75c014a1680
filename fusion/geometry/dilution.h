// Dilution of precision: by how much the geometry multiplies the noise of one observation.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace locus {

/// Position dilution: standard deviation of the position over that of one observation, `sigma_m`. Not a number or
/// huge where the covariance comes of a singular matrix, so ask `!(dilution <= limit)`.
template <int D>
double position_dilution(const Eigen::Matrix<double, D, D>& covariance_m2, double sigma_m) {
    return std::sqrt(covariance_m2.trace()) / sigma_m;
}

} // namespace locus
