// What is slow to compile, compiled once for all tests: Eigen's decompositions and Boost's quantiles take ten seconds
// in every file that names them.
#pragma once

#include <Eigen/Core>

namespace locus::test {

/// Of a symmetric matrix, ascending.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric);

Eigen::MatrixXd inverse(const Eigen::MatrixXd& square);

/// outer * inner * outer'.
Eigen::MatrixXd carried(const Eigen::MatrixXd& outer, const Eigen::MatrixXd& inner);

/// Error weighed by its covariance: chi-square of as many degrees of freedom as it has entries if that is honest.
double weighed_square(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance);

double chi_square_quantile(double degrees_of_freedom, double probability);

} // namespace locus::test
