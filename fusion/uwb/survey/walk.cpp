#include "fusion/uwb/survey/walk.h"

#include "fusion/filter/robust_gain.h"
#include "fusion/uwb/survey/correlation.h"
#include "fusion/uwb/survey/network.h"
#include "fusion/uwb/survey/walk_problem.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

namespace locus::uwb::survey {
namespace {

double robust_spread(std::vector<double> residuals) {
    if (residuals.empty()) return 0;
    for (double& residual : residuals) residual = std::abs(residual);
    const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
    std::ranges::nth_element(residuals, middle);
    return 1.4826 * *middle;
}

/// Of the biases alone, from the information of path and biases.
Eigen::MatrixXd covariance_of_biases(const Eigen::SparseMatrix<double>& information, Eigen::Index count) {
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(information);
    Eigen::MatrixXd covariance(count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
        Eigen::VectorXd one = Eigen::VectorXd::Zero(information.rows());
        one(information.rows() - count + i) = 1;
        covariance.col(i) = robust_covariance_factor * solver.solve(one).tail(count);
    }
    return covariance;
}

Biases result_of(const WalkProblem& problem, const std::vector<WalkRange>& ranges) {
    const auto count = problem.bias_m().size();
    const auto anchors = static_cast<std::size_t>(count);
    Biases found{true, problem.bias_m(), covariance_of_biases(problem.information(), count),
                 std::vector<std::size_t>(anchors), Eigen::VectorXd::Zero(count)};
    const std::vector<double> left_m = problem.left_m();
    std::vector<std::vector<double>> own_left_m(anchors);
    std::vector<double> worth_m(anchors, 1);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        own_left_m[ranges[i].anchor].push_back(left_m[i]);
        worth_m[ranges[i].anchor] = problem.worth_m(ranges[i]);
    }
    Eigen::VectorXd widened(count);
    for (std::size_t anchor = 0; anchor < anchors; ++anchor) {
        const auto i = static_cast<Eigen::Index>(anchor);
        found.counts[anchor] = own_left_m[anchor].size();
        found.spread_m(i) = robust_spread(own_left_m[anchor]);
        const double shown_m = found.spread_m(i) * std::sqrt(correlated_samples(own_left_m[anchor]));
        widened(i) = std::max(1.0, shown_m / worth_m[anchor]);
    }
    found.covariance = widened.asDiagonal() * found.covariance * widened.asDiagonal();
    return found;
}

/// Cauchy's location and its variance for errors that do not depend on each other.
struct Location {
    double at_m = 0;
    double variance = 0;
};

Location location_of(const std::vector<double>& errors_m, double start_m, double sigma_m) {
    double at_m = start_m, information = 0;
    for (int step = 0; step < 20; ++step) {
        double sum_m = 0;
        information = 0;
        for (const double error_m : errors_m) {
            const double weight = filter::cauchy_weight((error_m - at_m) / sigma_m, half_weight_sigma);
            sum_m += weight * error_m;
            information += weight;
        }
        at_m = sum_m / information;
    }
    return {at_m, robust_covariance_factor * sigma_m * sigma_m / information};
}

} // namespace

double Biases::sigma_m(Eigen::Index anchor) const { return std::sqrt(covariance(anchor, anchor)); }

double Biases::common_sigma_m() const {
    return std::sqrt(covariance.sum()) / static_cast<double>(std::max<Eigen::Index>(covariance.rows(), 1));
}

double Biases::own_sigma_m(Eigen::Index anchor) const {
    Eigen::VectorXd less_mean = Eigen::VectorXd::Constant(bias_m.size(), -1.0 / static_cast<double>(bias_m.size()));
    less_mean(anchor) += 1;
    return std::sqrt(less_mean.dot(covariance * less_mean));
}

Biases biases_of_walk(const Anchors& anchors_m, const std::vector<WalkRange>& ranges, const WalkSettings& settings) {
    if (ranges.empty()) return {};
    WalkProblem problem(anchors_m, ranges, settings);
    if (!problem.start()) return {};
    problem.descend();
    return result_of(problem, ranges);
}

Biases biases_of_errors(std::size_t anchors, const std::vector<KnownRange>& errors, double prior_m) {
    const auto count = static_cast<Eigen::Index>(anchors);
    Biases found{!errors.empty(), Eigen::VectorXd::Zero(count),
                 Eigen::MatrixXd::Identity(count, count) * prior_m * prior_m, std::vector<std::size_t>(anchors),
                 Eigen::VectorXd::Zero(count)};
    std::vector<std::vector<double>> series(anchors);
    for (const KnownRange& one : errors) series[one.anchor].push_back(one.error_m);
    for (Eigen::Index i = 0; i < count; ++i) {
        const auto& own = series[static_cast<std::size_t>(i)];
        found.counts[static_cast<std::size_t>(i)] = own.size();
        if (own.empty()) continue;
        auto about_m = own;
        std::ranges::sort(about_m);
        const double median_m = about_m[about_m.size() / 2];
        for (double& error_m : about_m) error_m -= median_m;
        found.spread_m(i) = std::max(robust_spread(about_m), 1e-4);
        const Location location = location_of(own, median_m, found.spread_m(i));
        found.bias_m(i) = location.at_m;
        found.covariance(i, i) = location.variance * correlated_samples(own);
    }
    return found;
}

} // namespace locus::uwb::survey
