#include "fusion/uwb/survey/walk_problem.h"

#include "fusion/filter/robust_gain.h"
#include "fusion/geometry/vector.h"
#include "fusion/uwb/solve.h"
#include "fusion/uwb/survey/network.h"

#include <Eigen/SparseCholesky>

namespace locus::uwb::survey {

std::vector<double> WalkProblem::rates() const {
    std::vector<double> rate_hz(static_cast<std::size_t>(anchors_m_.rows()));
    const double heard_s = settings_.step_s * static_cast<double>(knots_.size());
    for (const WalkRange& range : ranges_) rate_hz[range.anchor] += 1 / heard_s;
    return rate_hz;
}

WalkProblem::Place WalkProblem::place_of(const WalkRange& range) const {
    Place place;
    place.knot = knots_.before(range.time_s);
    const auto i = static_cast<Eigen::Index>(place.knot);
    const double length_s = knots_.time_s[place.knot + 1] - knots_.time_s[place.knot];
    place.share = std::clamp((range.time_s - knots_.time_s[place.knot]) / length_s, 0.0, 1.0);
    const Eigen::Vector3d at_m = (1 - place.share) * path_m_.col(i) + place.share * path_m_.col(i + 1);
    place.sight = sight_of(at_m, anchors_m_.row(static_cast<Eigen::Index>(range.anchor)).transpose());
    return place;
}

/// A fix of the last range of each anchor within a step and a half of a time.
std::optional<Vec3> WalkProblem::fix_about(double time_s) const {
    const double reach_s = 1.5 * settings_.step_s;
    std::vector<std::optional<RangeTo>> latest(static_cast<std::size_t>(anchors_m_.rows()));
    auto at = std::ranges::lower_bound(ranges_, time_s - reach_s, {}, &WalkRange::time_s);
    for (; at != ranges_.end() && at->time_s <= time_s + reach_s; ++at) {
        const auto row = anchors_m_.row(static_cast<Eigen::Index>(at->anchor));
        latest[at->anchor] = RangeTo{{row(0), row(1), row(2)}, at->range_m, at->sigma_m};
    }
    std::vector<RangeTo> heard;
    for (const auto& one : latest)
        if (one) heard.push_back(*one);
    const Fix fix = solve_ranges(heard, {});
    if (fix.reason != Exclusion::none) return {};
    return fix.position_site_m;
}

/// Fixes where there are some, the last of them in between. False when there is none at all.
bool WalkProblem::start() {
    std::optional<Vec3> last;
    std::size_t first = knots_.size();
    for (std::size_t i = 0; i < knots_.size(); ++i) {
        if (const auto fix = fix_about(knots_.time_s[i])) {
            last = fix;
            first = std::min(first, i);
        }
        if (last) path_m_.col(static_cast<Eigen::Index>(i)) = vector(*last);
    }
    if (!last) return false;
    for (std::size_t i = 0; i < first; ++i)
        path_m_.col(static_cast<Eigen::Index>(i)) = path_m_.col(static_cast<Eigen::Index>(first)).eval();
    return true;
}

void WalkProblem::add_range(Equations& equations, const WalkRange& range, double widening) const {
    const Place place = place_of(range);
    std::array<std::size_t, 7> at{};
    std::array<double, 7> slope{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double gradient = place.sight.gradient(static_cast<Eigen::Index>(axis)) / worth_m(range);
        at[axis] = 3 * place.knot + axis;
        at[axis + 3] = at[axis] + 3;
        slope[axis] = (1 - place.share) * gradient;
        slope[axis + 3] = place.share * gradient;
    }
    at[6] = bias_at(range.anchor);
    slope[6] = 1 / worth_m(range);
    const double left_m = residual_m(range, place);
    const double weight = filter::cauchy_weight(left_m / spread_m(range), widening * half_weight_sigma);
    equations.add(at, slope, left_m / worth_m(range), weight);
}

/// Second differences of the path are accelerations.
void WalkProblem::add_motion(Equations& equations) const {
    const double sag_m = settings_.acceleration_mps2 * settings_.step_s * settings_.step_s;
    for (std::size_t i = 1; i + 1 < knots_.size(); ++i) {
        if (knots_.begins[i] || knots_.begins[i + 1]) continue;
        const auto knot = static_cast<Eigen::Index>(i);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto row = static_cast<Eigen::Index>(axis);
            const double bend_m = path_m_(row, knot - 1) - 2 * path_m_(row, knot) + path_m_(row, knot + 1);
            equations.add<3>({3 * i - 3 + axis, 3 * i + axis, 3 * i + 3 + axis}, {1 / sag_m, -2 / sag_m, 1 / sag_m},
                             -bend_m / sag_m, 1);
        }
    }
}

/// Inverse of own^2 I + common^2 11' (Sherman-Morrison).
void WalkProblem::add_prior(Equations& equations) const {
    const double own = settings_.own_prior_m * settings_.own_prior_m;
    const double common = settings_.common_prior_m * settings_.common_prior_m;
    const double shared = common / (own * (own + static_cast<double>(bias_m_.size()) * common));
    for (Eigen::Index i = 0; i < bias_m_.size(); ++i) {
        const double pull = bias_m_(i) / own - shared * bias_m_.sum();
        equations.add_prior(bias_at(static_cast<std::size_t>(i)), pull);
        for (Eigen::Index j = 0; j <= i; ++j)
            equations.add_information(bias_at(static_cast<std::size_t>(i)), bias_at(static_cast<std::size_t>(j)),
                                      (i == j ? 1 / own : 0) - shared);
    }
}

Equations WalkProblem::equations(double widening) const {
    Equations sum(3 * knots_.size() + static_cast<std::size_t>(anchors_m_.rows()));
    for (const WalkRange& range : ranges_) add_range(sum, range, widening);
    add_motion(sum);
    add_prior(sum);
    constexpr double hardly = 1e-3; // per metre: keeps points solvable that nothing was heard at
    for (std::size_t i = 0; i < 3 * knots_.size(); ++i) sum.add<1>({i}, {hardly}, 0, 1);
    return sum;
}

/// One Gauss-Newton step; its largest part, or 0 when there is none.
double WalkProblem::step(double widening) {
    const Equations sum = equations(widening);
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(sum.information());
    if (solver.info() != Eigen::Success) return 0;
    Eigen::VectorXd step_m = solver.solve(sum.projection());
    constexpr double longest_m = 2;
    step_m = step_m.cwiseMax(-longest_m).cwiseMin(longest_m);
    const auto path = path_m_.size();
    path_m_ += step_m.head(path).reshaped(3, path_m_.cols());
    bias_m_ += step_m.tail(bias_m_.size());
    return step_m.cwiseAbs().maxCoeff();
}

void WalkProblem::descend() {
    constexpr int steps_at_most = 25;
    for (const double widening : {16.0, 4.0, 1.0}) {
        const double settled_m = widening > 1 ? 0.05 : 0.002;
        for (int i = 0; i < steps_at_most && step(widening) > settled_m; ++i) {
        }
    }
}

std::vector<double> WalkProblem::left_m() const {
    std::vector<double> left_m;
    for (const WalkRange& range : ranges_) left_m.push_back(residual_m(range, place_of(range)));
    return left_m;
}

} // namespace locus::uwb::survey
