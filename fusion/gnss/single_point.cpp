#include "fusion/gnss/single_point.h"

#include "fusion/filter/gate.h"
#include "fusion/gnss/least_squares.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace locus::gnss {
namespace {

constexpr int axes = 3, point_unknowns = axes + clock_count, velocity_unknowns = axes + 1;
using PointEquations = LeastSquares<point_unknowns>;
using VelocityEquations = LeastSquares<velocity_unknowns>;

std::size_t clock_index(const SightFrom& s) {
    return static_cast<std::size_t>(clock_of(s.sight.reception.constellation));
}

bool gives_range(const SightFrom& s) { return s.reason == Exclusion::none; }
bool gives_rate(const SightFrom& s) { return gives_range(s) && s.rate_agrees && std::isfinite(s.sight.rate_mps); }

PointEquations::Row range_row(const SightFrom& s) {
    PointEquations::Row row = PointEquations::Row::Zero();
    row.head<axes>() = -s.towards;
    row[axes + clock_of(s.sight.reception.constellation)] = 1;
    return row;
}

double range_residual_m(const SightFrom& s, const SinglePoint& at) {
    return s.range_m - (s.satellite_ecef_m - at.position_ecef_m).norm() - at.clocks_m[clock_index(s)];
}

VelocityEquations::Row rate_row(const SightFrom& s) {
    VelocityEquations::Row row;
    row << -s.towards, 1;
    return row;
}

/// Over what a receiver at rest with a perfect clock would measure.
double rate_residual_mps(const SightFrom& s) { return s.sight.rate_mps - s.towards.dot(s.velocity_ecef_mps); }

PointEquations range_equations(std::span<const SightFrom> sights, const SinglePoint& at) {
    PointEquations equations;
    std::array<bool, clock_count> heard{};
    for (const SightFrom& s : sights) {
        if (!gives_range(s)) continue;
        heard[clock_index(s)] = true;
        equations.add(range_row(s), range_residual_m(s, at), s.variance_m2);
    }
    for (std::size_t i = 0; i < heard.size(); ++i)
        if (!heard[i]) equations.hold(axes + static_cast<int>(i));
    return equations;
}

VelocityEquations rate_equations(std::span<const SightFrom> sights) {
    VelocityEquations equations;
    for (const SightFrom& s : sights)
        if (gives_rate(s)) equations.add(rate_row(s), rate_residual_mps(s), s.rate_variance_m2ps2);
    return equations;
}

void go(SinglePoint& point, const PointEquations::Row& step) {
    point.position_ecef_m += step.head<axes>();
    for (std::size_t i = 0; i < point.clocks_m.size(); ++i) point.clocks_m[i] += step[axes + static_cast<int>(i)];
}

/// Gauss-Newton. The equations of the last step, which is next to nothing; empty when they have no solution.
std::optional<PointEquations> converge(std::span<SightFrom> sights, const Sky& sky, const Observer& observer,
                                       SinglePoint& point) {
    constexpr int most_steps = 20;
    constexpr double near_m = 1e5, there_m = 1e-4;
    double last_m = std::numeric_limits<double>::infinity();
    for (int i = 0; i < most_steps; ++i) {
        if (last_m < near_m)
            observer.observe(sights, sky, point.position_ecef_m);
        else
            Observer::turn(sights, point.position_ecef_m);
        PointEquations equations = range_equations(sights, point);
        if (equations.redundancy() < 0 || !equations.solve()) return std::nullopt;
        go(point, equations.step());
        const bool seen = std::exchange(last_m, equations.step().norm()) < near_m;
        if (seen && last_m < there_m) return equations;
    }
    return std::nullopt;
}

template <class Outlying>
SightFrom& odd_one(std::span<SightFrom> sights, const Outlying& outlying) {
    return *std::ranges::max_element(sights, {}, outlying);
}

/// Those that were left out one by one without the others coming to agree: nothing tells that they were the wrong ones.
void bring_back(std::span<SightFrom> sights) {
    for (SightFrom& s : sights)
        if (s.reason == Exclusion::inconsistent) s.reason = Exclusion::none;
}

template <int N>
double widening(const LeastSquares<N>& equations, bool consistent) {
    return consistent ? 1 : std::max(1.0, equations.cost_after() / equations.redundancy());
}

/// A position less certain than a kilometre is none: the satellites stand in a line.
bool is_possible(const SinglePoint& point) {
    constexpr double worst_m = 1000, lowest_m = -1000, highest_m = 100e3;
    if (!(point.covariance_m2.trace() < worst_m * worst_m)) return false;
    const double height_m = geodetic(point.position_ecef_m).height_ellipsoid_m;
    return height_m > lowest_m && height_m < highest_m;
}

} // namespace

SinglePointSolver::SinglePointSolver(const GnssSettings& settings)
    : observer_{settings}, normal_quantile_{filter::gate_in_sigma(2 * settings.false_alarm)} {}

std::optional<SinglePoint> SinglePointSolver::solve(std::span<SightFrom> sights, const Sky& sky,
                                                    const Eigen::Vector3d& near_ecef_m) const noexcept {
    SinglePoint point;
    point.position_ecef_m = near_ecef_m;
    auto equations = converge(sights, sky, observer_, point);
    while (equations && !agree(*equations, normal_quantile_) && tells_which(*equations)) {
        odd_one(sights, [&](const SightFrom& s) {
            return gives_range(s) ? equations->outlying(range_row(s), range_residual_m(s, point), s.variance_m2) : -1;
        }).reason = Exclusion::inconsistent;
        equations = converge(sights, sky, observer_, point);
    }
    if (equations && !agree(*equations, normal_quantile_)) {
        bring_back(sights);
        equations = converge(sights, sky, observer_, point);
    }
    if (!equations) return std::nullopt;
    point.consistent = agree(*equations, normal_quantile_);
    point.covariance_m2 = equations->covariance().topLeftCorner<axes, axes>() * widening(*equations, point.consistent);
    if (!is_possible(point)) return std::nullopt;
    point.satellites = static_cast<int>(std::ranges::count_if(sights, gives_range));
    point.corrected = static_cast<int>(
        std::ranges::count_if(sights, [](const SightFrom& s) { return gives_range(s) && s.is_corrected; }));
    solve_velocity(sights, point);
    return point;
}

void SinglePointSolver::solve_velocity(std::span<SightFrom> sights, SinglePoint& point) const noexcept {
    for (std::size_t left_out = 0; left_out <= sights.size(); ++left_out) {
        VelocityEquations equations = rate_equations(sights);
        if (equations.redundancy() < 0 || !equations.solve()) return;
        const bool consistent = agree(equations, normal_quantile_);
        if (consistent || !tells_which(equations)) {
            point.velocity_ecef_mps = equations.step().head<axes>();
            point.velocity_covariance_m2ps2 =
                equations.covariance().topLeftCorner<axes, axes>() * widening(equations, consistent);
            point.clock_drift_mps = equations.step()[axes];
            return;
        }
        odd_one(sights, [&](const SightFrom& s) {
            return gives_rate(s) ? equations.outlying(rate_row(s), rate_residual_mps(s), s.rate_variance_m2ps2) : -1;
        }).rate_agrees = false;
    }
}

} // namespace locus::gnss
