#include "tests/support/heavy.h"

#include <Eigen/Dense>
#include <boost/math/distributions/chi_squared.hpp>

namespace locus::test {

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric) {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& square) { return square.inverse(); }

Eigen::MatrixXd carried(const Eigen::MatrixXd& outer, const Eigen::MatrixXd& inner) {
    return outer * inner * outer.transpose();
}

double weighed_square(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance) {
    return error.dot(covariance.llt().solve(error));
}

double chi_square_quantile(double degrees_of_freedom, double probability) {
    return boost::math::quantile(boost::math::chi_squared(degrees_of_freedom), probability);
}

} // namespace locus::test
