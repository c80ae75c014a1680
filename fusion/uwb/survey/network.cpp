#include "fusion/uwb/survey/network.h"

#include "fusion/uwb/survey/pair_fit.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace locus::uwb::survey {
namespace {

constexpr int most_steps = 200;
constexpr double negligible_step_m = 1e-7;

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
    if (unknowns.count == 0) return descend(pairs, sought, start_m);
    return better(descend(pairs, sought, start_m),
                  descend_in_scales(pairs, unknowns, snooped(pairs, unknowns, start_m), {1}));
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
