#include "fusion/uwb/survey/network.h"

#include "fusion/filter/robust_gain.h"
#include "fusion/uwb/range_model.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace locus::uwb::survey {
namespace {

constexpr int most_steps = 200;
constexpr double negligible_step_m = 1e-7;
/// A direction whose eigenvalue is this small beside the largest is not determined at all.
constexpr double singular = 1e-12;

/// The sought coordinates as one vector: number of each, or -1.
struct Unknowns {
    explicit Unknowns(const Sought& sought) : number(sought.rows(), 3) {
        for (Eigen::Index station = 0; station < sought.rows(); ++station)
            for (int axis = 0; axis < 3; ++axis) number(station, axis) = sought(station, axis) ? count++ : -1;
    }
    Eigen::Array<Eigen::Index, Eigen::Dynamic, 3> number;
    Eigen::Index count = 0;
};

struct Normal {
    Eigen::MatrixXd information;
    Eigen::VectorXd projection;
    double cost = 0;
};

/// A pair's row: gradient by the six coordinates of its ends, over its sigma.
struct PairRow {
    std::array<Eigen::Index, 6> unknown{};
    Eigen::Matrix<double, 6, 1> slope;
    double residual = 0;
};

PairRow row_of(const PairRange& pair, const Unknowns& unknowns, const Positions& at_m) {
    const auto a = static_cast<Eigen::Index>(pair.a), b = static_cast<Eigen::Index>(pair.b);
    const Sight sight = sight_of(at_m.row(a).transpose(), at_m.row(b).transpose());
    PairRow row;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto column = static_cast<Eigen::Index>(axis);
        row.unknown[axis] = unknowns.number(a, column);
        row.unknown[axis + 3] = unknowns.number(b, column);
    }
    row.slope << sight.gradient, -sight.gradient;
    row.slope /= pair.sigma_m;
    row.residual = (pair.range_m - sight.range_m) / pair.sigma_m;
    return row;
}

bool usable(const PairRange& pair, Eigen::Index stations) {
    const auto count = static_cast<std::size_t>(stations);
    return pair.a != pair.b && pair.a < count && pair.b < count && pair.sigma_m > 0 && std::isfinite(pair.range_m);
}

void add(Normal& normal, const PairRow& row, double weight) {
    for (std::size_t i = 0; i < 6; ++i) {
        if (row.unknown[i] < 0) continue;
        const auto slope_i = row.slope(static_cast<Eigen::Index>(i));
        normal.projection(row.unknown[i]) += weight * slope_i * row.residual;
        for (std::size_t j = 0; j < 6; ++j)
            if (row.unknown[j] >= 0)
                normal.information(row.unknown[i], row.unknown[j]) +=
                    weight * slope_i * row.slope(static_cast<Eigen::Index>(j));
    }
}

double robust_cost(double residual, double scale) {
    const double u = residual / scale;
    return scale * scale * std::log1p(u * u);
}

Normal linearise(const std::vector<PairRange>& pairs, const Unknowns& unknowns, const Positions& at_m, double scale) {
    Normal normal{Eigen::MatrixXd::Zero(unknowns.count, unknowns.count), Eigen::VectorXd::Zero(unknowns.count), 0};
    for (const PairRange& pair : pairs) {
        if (!usable(pair, at_m.rows())) continue;
        const PairRow row = row_of(pair, unknowns, at_m);
        add(normal, row, filter::cauchy_weight(row.residual, scale));
        normal.cost += robust_cost(row.residual, scale);
    }
    return normal;
}

double cost_at(const std::vector<PairRange>& pairs, const Positions& at_m, double scale) {
    double cost = 0;
    for (const PairRange& pair : pairs) {
        if (!usable(pair, at_m.rows())) continue;
        const auto a = static_cast<Eigen::Index>(pair.a), b = static_cast<Eigen::Index>(pair.b);
        cost += robust_cost((pair.range_m - (at_m.row(a) - at_m.row(b)).norm()) / pair.sigma_m, scale);
    }
    return cost;
}

Positions moved(const Positions& from_m, const Unknowns& unknowns, const Eigen::VectorXd& step_m) {
    Positions to_m = from_m;
    for (Eigen::Index station = 0; station < from_m.rows(); ++station)
        for (int axis = 0; axis < 3; ++axis)
            if (const auto i = unknowns.number(station, axis); i >= 0) to_m(station, axis) += step_m(i);
    return to_m;
}

/// Marquardt's damping by the diagonal, with a floor: a frame that nothing fixes leaves directions without any.
Eigen::VectorXd damped_step(const Normal& normal, double damping) {
    Eigen::MatrixXd damped = normal.information;
    const double floor = 1e-9 * std::max(1.0, normal.information.diagonal().maxCoeff());
    damped.diagonal() += damping * normal.information.diagonal();
    damped.diagonal().array() += floor;
    return damped.ldlt().solve(normal.projection);
}

Positions descend_at_scale(const std::vector<PairRange>& pairs, const Unknowns& unknowns, Positions at_m,
                           double scale) {
    double damping = 1e-3;
    Normal normal = linearise(pairs, unknowns, at_m, scale);
    for (int step = 0; step < most_steps && damping < 1e8; ++step) {
        const Eigen::VectorXd step_m = damped_step(normal, damping);
        if (!step_m.allFinite()) break;
        const Positions next_m = moved(at_m, unknowns, step_m);
        if (cost_at(pairs, next_m, scale) > normal.cost) {
            damping *= 10;
            continue;
        }
        at_m = next_m;
        if (step_m.norm() < negligible_step_m) break;
        damping = std::max(damping / 10, 1e-9);
        normal = linearise(pairs, unknowns, at_m, scale);
    }
    return at_m;
}

/// Standard deviation that the residuals themselves show, in units of the stated one: the weighted mean square, over
/// what it comes to for normal errors, and for the unknowns that it had to serve. From few pairs nothing is concluded.
double shown_scale(const std::vector<PairRange>& pairs, const Adjustment& result) {
    constexpr int enough = 3;
    constexpr double of_normal_errors = 0.795; // E[w u^2] / E[w]
    if (result.redundancy < enough) return 1;
    double squares = 0, weights = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const double u = result.pairs[i].residual_m / pairs[i].sigma_m;
        squares += result.pairs[i].weight * u * u;
        weights += result.pairs[i].weight;
    }
    const double mean_square = squares / std::max(weights, 1e-9) / of_normal_errors;
    return std::sqrt(std::max(1.0, mean_square * static_cast<double>(pairs.size()) / result.redundancy));
}

struct Spread {
    Eigen::MatrixXd covariance; ///< of what is determined
    Eigen::VectorXd sigma;      ///< infinite of what is not
};

Spread spread_of(const Eigen::MatrixXd& information) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(information);
    const double limit = singular * std::max(1.0, solver.eigenvalues().tail(1)(0));
    Spread spread{Eigen::MatrixXd::Zero(information.rows(), information.cols()), {}};
    Eigen::VectorXd lost = Eigen::VectorXd::Zero(information.rows());
    for (Eigen::Index i = 0; i < information.rows(); ++i) {
        const Eigen::VectorXd direction = solver.eigenvectors().col(i);
        if (solver.eigenvalues()(i) > limit)
            spread.covariance += robust_covariance_factor / solver.eigenvalues()(i) * direction * direction.transpose();
        else
            lost += direction.cwiseAbs2();
    }
    spread.sigma = spread.covariance.diagonal().cwiseSqrt();
    constexpr double noticeable = 1e-6;
    for (Eigen::Index i = 0; i < lost.size(); ++i)
        if (lost(i) > noticeable) spread.sigma(i) = std::numeric_limits<double>::infinity();
    return spread;
}

/// Variance of a pair's predicted distance in units of its own noise: what is left of its residual is 1 less that.
double leverage(const PairRow& row, const Eigen::MatrixXd& covariance) {
    double sum = 0;
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
            if (row.unknown[i] >= 0 && row.unknown[j] >= 0)
                sum += row.slope(static_cast<Eigen::Index>(i)) * row.slope(static_cast<Eigen::Index>(j)) *
                       covariance(row.unknown[i], row.unknown[j]);
    return sum;
}

PairFit fit_of(const PairRange& pair, const Unknowns& unknowns, const Positions& at_m,
               const Eigen::MatrixXd& covariance, double scale = half_weight_sigma) {
    const PairRow row = row_of(pair, unknowns, at_m);
    PairFit fit{row.residual * pair.sigma_m, filter::cauchy_weight(row.residual, scale), 0};
    const double controlled = 1 - fit.weight * leverage(row, covariance);
    constexpr double hardly = 0.02;
    if (controlled > hardly) fit.normalised = row.residual / std::sqrt(controlled);
    return fit;
}

Descent descend_in_scales(const std::vector<PairRange>& pairs, const Unknowns& unknowns, const Positions& start_m,
                          std::initializer_list<double> widenings) {
    Positions at_m = start_m;
    for (const double widening : widenings)
        at_m = descend_at_scale(pairs, unknowns, at_m, widening * half_weight_sigma);
    return {at_m, cost_at(pairs, at_m, half_weight_sigma)};
}

/// The pair that fits worst among those that others control; the number of pairs when all fit.
std::size_t misfit(const std::vector<PairRange>& pairs, const Unknowns& unknowns, const Positions& at_m) {
    constexpr double wide = 1e6;
    const Eigen::MatrixXd covariance = spread_of(linearise(pairs, unknowns, at_m, wide).information).covariance;
    double worst = 4;
    std::size_t found = pairs.size();
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (const double off = std::abs(fit_of(pairs[i], unknowns, at_m, covariance, wide).normalised); off > worst) {
            worst = off;
            found = i;
        }
    return found;
}

Positions snooped(std::vector<PairRange> pairs, const Unknowns& unknowns, Positions at_m) {
    constexpr double wide = 1e6;
    const std::size_t at_least = pairs.size() - pairs.size() / 4;
    at_m = descend_at_scale(pairs, unknowns, at_m, wide);
    while (pairs.size() > at_least) {
        const std::size_t worst = misfit(pairs, unknowns, at_m);
        if (worst == pairs.size()) break;
        pairs.erase(pairs.begin() + static_cast<std::ptrdiff_t>(worst));
        at_m = descend_at_scale(pairs, unknowns, at_m, wide);
    }
    return at_m;
}

Descent better(const Descent& one, const Descent& other) { return other.cost < one.cost ? other : one; }

} // namespace

Descent descend(const std::vector<PairRange>& pairs, const Sought& sought, const Positions& start_m) {
    const Unknowns unknowns(sought);
    if (unknowns.count == 0) return {start_m, cost_at(pairs, start_m, half_weight_sigma)};
    return better(descend_in_scales(pairs, unknowns, start_m, {1}),
                  descend_in_scales(pairs, unknowns, start_m, {64, 16, 4, 1}));
}

Descent descend_snooping(const std::vector<PairRange>& pairs, const Sought& sought, const Positions& start_m) {
    const Unknowns unknowns(sought);
    const Descent plain = descend(pairs, sought, start_m);
    if (unknowns.count == 0) return plain;
    return better(plain, descend_in_scales(pairs, unknowns, snooped(pairs, unknowns, start_m), {1}));
}

Adjustment adjust(const std::vector<PairRange>& pairs, const Sought& sought, const Positions& start_m) {
    const Descent found = descend(pairs, sought, start_m);
    const Unknowns unknowns(sought);
    Adjustment result{found.position_m, Positions::Zero(start_m.rows(), 3), {}, found.cost, 0, 1};
    Spread spread{{}, {}};
    if (unknowns.count > 0)
        spread = spread_of(linearise(pairs, unknowns, found.position_m, half_weight_sigma).information);
    for (const PairRange& pair : pairs)
        result.pairs.push_back(usable(pair, start_m.rows())
                                   ? fit_of(pair, unknowns, found.position_m, spread.covariance)
                                   : PairFit{0, 0, 0});
    result.redundancy = static_cast<int>(pairs.size()) - static_cast<int>(unknowns.count);
    result.scale = shown_scale(pairs, result);
    for (Eigen::Index station = 0; station < start_m.rows(); ++station)
        for (int axis = 0; axis < 3; ++axis)
            if (const auto i = unknowns.number(station, axis); i >= 0)
                result.sigma_m(station, axis) = result.scale * spread.sigma(i);
    return result;
}

} // namespace locus::uwb::survey
