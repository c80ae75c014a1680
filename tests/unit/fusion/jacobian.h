// The one harness that every analytic Jacobian of the house is checked with: central differences against the formula.
#pragma once

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <type_traits>

namespace locus::test {

/// Vectors pass through; a scalar becomes a vector of one.
template <class Value>
Eigen::VectorXd as_vector(const Value& value) {
    if constexpr (std::is_arithmetic_v<Value>)
        return Eigen::VectorXd::Constant(1, value);
    else
        return value;
}

/// Central differences, outputs x inputs. `function` takes a column vector and gives a column vector or a scalar.
template <class Function>
Eigen::MatrixXd numerical_jacobian(const Function& function, const Eigen::VectorXd& point, double step = 1e-6) {
    const Eigen::Index outputs = as_vector(function(point)).size();
    Eigen::MatrixXd jacobian(outputs, point.size());
    for (Eigen::Index column = 0; column < point.size(); ++column) {
        Eigen::VectorXd above = point, below = point;
        above(column) += step;
        below(column) -= step;
        jacobian.col(column) = (as_vector(function(above)) - as_vector(function(below))) / (2 * step);
    }
    return jacobian;
}

/// True when `analytic` (outputs x inputs) is finite and within `tolerance` of the differences in every entry.
template <class Function>
testing::AssertionResult jacobian_matches(const Function& function, const Eigen::MatrixXd& analytic,
                                          const Eigen::VectorXd& point, double tolerance = 1e-6, double step = 1e-6) {
    const Eigen::MatrixXd numerical = numerical_jacobian(function, point, step);
    if (numerical.rows() != analytic.rows() || numerical.cols() != analytic.cols())
        return testing::AssertionFailure() << "analytic is " << analytic.rows() << " x " << analytic.cols()
                                           << ", the function wants " << numerical.rows() << " x " << numerical.cols();
    if (analytic.allFinite() && (analytic - numerical).cwiseAbs().maxCoeff() <= tolerance)
        return testing::AssertionSuccess();
    return testing::AssertionFailure() << "at " << point.transpose() << "\nanalytic\n"
                                       << analytic << "\nnumerical\n"
                                       << numerical;
}

} // namespace locus::test
