#include "fusion/uwb/survey/walk.h"

#include "fusion/filter/robust_gain.h"
#include "fusion/geometry/vector.h"
#include "fusion/uwb/range_model.h"
#include "fusion/uwb/solve.h"
#include "fusion/uwb/survey/correlation.h"
#include "fusion/uwb/survey/network.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace locus::uwb::survey {
namespace {

using Anchors = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Points of the path: a stretch without gaps has them every step, and nothing joins two stretches.
struct Knots {
    std::vector<double> time_s;
    std::vector<bool> begins; ///< the first of its stretch

    Knots(const std::vector<WalkRange>& ranges, const WalkSettings& settings) {
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            const bool begin = i == 0 || ranges[i].time_s - ranges[i - 1].time_s > settings.gap_s;
            if (begin) add(ranges[i].time_s, true);
            while (ranges[i].time_s > time_s.back()) add(time_s.back() + settings.step_s, false);
            if (begin) add(time_s.back() + settings.step_s, false);
        }
    }
    void add(double time, bool begin) {
        time_s.push_back(time);
        begins.push_back(begin);
    }
    std::size_t size() const { return time_s.size(); }
    /// The point before a time, with another of the same stretch behind it.
    std::size_t before(double time) const {
        const auto after = std::ranges::upper_bound(time_s, time) - time_s.begin();
        auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - 1, 0));
        if (i + 1 == size() || begins[i + 1]) --i;
        return i;
    }
};

/// Sparse normal equations: points of the path first, then the biases.
class Equations {
  public:
    Equations(std::size_t unknowns) : projection_{Eigen::VectorXd::Zero(static_cast<Eigen::Index>(unknowns))} {}

    template <std::size_t N>
    void add(const std::array<std::size_t, N>& at, const std::array<double, N>& slope, double residual, double weight) {
        for (std::size_t i = 0; i < N; ++i) {
            projection_(static_cast<Eigen::Index>(at[i])) += weight * slope[i] * residual;
            for (std::size_t j = 0; j < N; ++j)
                if (at[j] <= at[i])
                    entries_.emplace_back(static_cast<int>(at[i]), static_cast<int>(at[j]),
                                          weight * slope[i] * slope[j]);
        }
    }
    void add_prior(std::size_t at, double pull) { projection_(static_cast<Eigen::Index>(at)) -= pull; }
    void add_information(std::size_t at, std::size_t before, double value) {
        entries_.emplace_back(static_cast<int>(at), static_cast<int>(before), value);
    }
    Eigen::SparseMatrix<double> information() const {
        Eigen::SparseMatrix<double> lower(projection_.size(), projection_.size());
        lower.setFromTriplets(entries_.begin(), entries_.end());
        return lower;
    }
    const Eigen::VectorXd& projection() const { return projection_; }

  private:
    std::vector<Eigen::Triplet<double>> entries_;
    Eigen::VectorXd projection_;
};

class WalkProblem {
  public:
    WalkProblem(const Anchors& anchors_m, const std::vector<WalkRange>& ranges, const WalkSettings& settings)
        : anchors_m_{anchors_m}, ranges_{ranges}, settings_{settings}, knots_{ranges, settings},
          path_m_{Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(knots_.size()))},
          bias_m_{Eigen::VectorXd::Zero(anchors_m.rows())}, rate_hz_{rates()} {}

    bool start();
    void descend();
    Biases result() const;

  private:
    const Anchors& anchors_m_;
    const std::vector<WalkRange>& ranges_;
    const WalkSettings& settings_;
    Knots knots_;
    Eigen::Matrix3Xd path_m_;
    Eigen::VectorXd bias_m_;
    std::vector<double> rate_hz_; ///< ranges a second of each anchor

    struct Place {
        std::size_t knot = 0;
        double share = 0;
        Sight sight;
    };

    std::size_t bias_at(std::size_t anchor) const { return 3 * knots_.size() + anchor; }
    Place place_of(const WalkRange& range) const;
    double residual_m(const WalkRange& range, const Place& place) const {
        return range.range_m - place.sight.range_m - bias_m_(static_cast<Eigen::Index>(range.anchor));
    }
    std::vector<double> rates() const;
    /// Of one range by itself: by it a range is an outlier.
    double spread_m(const WalkRange& range) const { return std::hypot(range.sigma_m, settings_.held_error_m); }
    /// Of one range among its like: over a long time as many ranges as there are say no more of a constant than this
    /// has them say. The held error's variance over a time t is 2 T / t times its own, of r t ranges.
    double worth_m(const WalkRange& range) const {
        const double together = 2 * settings_.held_error_s * rate_hz_[range.anchor];
        return std::hypot(range.sigma_m, std::sqrt(std::max(together, 1.0)) * settings_.held_error_m);
    }
    std::optional<Vec3> fix_about(double time_s) const;
    void add_range(Equations& equations, const WalkRange& range, double widening) const;
    void add_motion(Equations& equations) const;
    void add_prior(Equations& equations) const;
    Equations equations(double widening) const;
    double step(double widening);
};

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
    constexpr int most_steps = 25;
    for (const double widening : {16.0, 4.0, 1.0}) {
        const double settled_m = widening > 1 ? 0.05 : 0.002;
        for (int i = 0; i < most_steps && step(widening) > settled_m; ++i) {
        }
    }
}

double robust_spread(std::vector<double> residuals) {
    if (residuals.empty()) return 0;
    for (double& residual : residuals) residual = std::abs(residual);
    const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
    std::ranges::nth_element(residuals, middle);
    return 1.4826 * *middle;
}

Biases WalkProblem::result() const {
    const auto anchors = static_cast<std::size_t>(anchors_m_.rows());
    const auto count = bias_m_.size();
    Biases found{true, bias_m_, Eigen::MatrixXd::Zero(count, count), std::vector<std::size_t>(anchors),
                 Eigen::VectorXd::Zero(count)};
    std::vector<std::vector<double>> left_m(anchors);
    std::vector<double> worth(anchors, 1);
    for (const WalkRange& range : ranges_) {
        left_m[range.anchor].push_back(residual_m(range, place_of(range)));
        worth[range.anchor] = worth_m(range);
    }
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(equations(1).information());
    Eigen::VectorXd widened(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const auto anchor = static_cast<std::size_t>(i);
        Eigen::VectorXd one = Eigen::VectorXd::Zero(path_m_.size() + count);
        one(path_m_.size() + i) = 1;
        found.covariance.col(i) = robust_covariance_factor * solver.solve(one).tail(count);
        found.counts[anchor] = left_m[anchor].size();
        found.spread_m(i) = robust_spread(left_m[anchor]);
        const double shown_m = found.spread_m(i) * std::sqrt(correlated_samples(left_m[anchor]));
        widened(i) = std::max(1.0, shown_m / worth[anchor]);
    }
    found.covariance = widened.asDiagonal() * found.covariance * widened.asDiagonal();
    return found;
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
    return problem.result();
}

Biases biases_of_errors(std::size_t anchors, const std::vector<KnownRange>& errors, double prior_m) {
    const auto count = static_cast<Eigen::Index>(anchors);
    Biases found{!errors.empty(), Eigen::VectorXd::Zero(count),
                 Eigen::MatrixXd::Identity(count, count) * prior_m * prior_m, std::vector<std::size_t>(anchors),
                 Eigen::VectorXd::Zero(count)};
    std::vector<std::vector<double>> series(anchors);
    for (const KnownRange& one : errors) series[one.anchor].push_back(one.error_m);
    for (Eigen::Index i = 0; i < count; ++i) {
        auto& own = series[static_cast<std::size_t>(i)];
        found.counts[static_cast<std::size_t>(i)] = own.size();
        if (own.empty()) continue;
        auto sorted = own;
        std::ranges::sort(sorted);
        double bias_m = sorted[sorted.size() / 2], information = 0;
        for (double& error_m : sorted) error_m -= bias_m;
        const double sigma_m = std::max(robust_spread(sorted), 1e-4);
        for (int step = 0; step < 20; ++step) {
            double sum_m = 0;
            information = 0;
            for (const double error_m : own) {
                const double weight = filter::cauchy_weight((error_m - bias_m) / sigma_m, half_weight_sigma);
                sum_m += weight * error_m;
                information += weight;
            }
            bias_m = sum_m / information;
        }
        found.bias_m(i) = bias_m;
        found.spread_m(i) = sigma_m;
        found.covariance(i, i) = robust_covariance_factor * sigma_m * sigma_m / information * correlated_samples(own);
    }
    return found;
}

} // namespace locus::uwb::survey
