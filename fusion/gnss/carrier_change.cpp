#include "fusion/gnss/carrier_change.h"

#include "fusion/gnss/least_squares.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace locus::gnss {
namespace {

using StepEquations = LeastSquares<4>;

/// Receivers count the lock in steps of an epoch or finer.
constexpr double lock_step_s = 0.05;
/// How an acceleration changes: ISO 15622 lets a cruise control change it by 2.5 m/s^3, and drivers are like that.
constexpr double jerk_mps3 = 2.5;

constexpr std::size_t most_changes = 64;

double square_of(double x) { return x * x; }

StepEquations step_equations(std::span<const CarrierEquation> equations) {
    StepEquations fit;
    for (const CarrierEquation& one : equations)
        if (one.agrees) fit.add(one.row, one.residual_m, one.variance_m2);
    return fit;
}

bool steps_agree(const StepEquations& fit, double normal_quantile) {
    return fit.cost_after() <= chi_square_limit(fit.redundancy(), normal_quantile);
}

} // namespace

double change_sigma_m(const CarrierSight& before, const CarrierSight& now, double dt_s) noexcept {
    return std::sqrt(square_of(before.sigma_m) + square_of(now.sigma_m) + square_of(dt_s * now.drift_mps));
}

bool is_unbroken(const CarrierSight& before, const CarrierSight& now, double dt_s) noexcept {
    const double lock_s{now.lock_s}, grown_s = lock_s - double{before.lock_s};
    return lock_s >= dt_s - lock_step_s && grown_s >= 0 && grown_s <= dt_s + lock_step_s;
}

double beyond_doppler_m(const CarrierSight& before, const CarrierSight& now, double dt_s) noexcept {
    return now.carrier_m - before.carrier_m - dt_s * (before.rate_mps + now.rate_mps) / 2;
}

// The mean of the rates at both ends is the mean rate but for a twelfth of dt^2 times the jerk (trapezoidal rule).
double beyond_doppler_sigma_m(const CarrierSight& before, const CarrierSight& now, double dt_s) noexcept {
    const double by_rates_m = dt_s * std::hypot(before.rate_sigma_mps, now.rate_sigma_mps) / 2;
    const double by_jerk_m = jerk_mps3 * dt_s * dt_s * dt_s / 12;
    return std::hypot(change_sigma_m(before, now, dt_s), by_rates_m, by_jerk_m);
}

void leave_out_against_doppler(std::span<CarrierEquation> equations, double gate_in_sigma) noexcept {
    std::array<double, most_changes> beyond_m{};
    std::size_t count = 0;
    for (const CarrierEquation& one : equations)
        if (std::isfinite(one.beyond_m) && count < beyond_m.size()) beyond_m[count++] = one.beyond_m;
    if (count < 3) return;
    const auto middle = beyond_m.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(beyond_m.begin(), middle, beyond_m.begin() + static_cast<std::ptrdiff_t>(count));
    for (CarrierEquation& one : equations)
        if (std::abs(one.beyond_m - *middle) > gate_in_sigma * one.beyond_sigma_m) one.agrees = false;
}

void leave_out_slips(std::span<CarrierEquation> equations, double normal_quantile) noexcept {
    constexpr int tells_which = 3; // as in single_point.cpp
    for (StepEquations fit = step_equations(equations); fit.redundancy() > 0; fit = step_equations(equations)) {
        const bool solved = fit.solve();
        if (solved && steps_agree(fit, normal_quantile)) return;
        if (!solved || fit.redundancy() < tells_which) {
            for (CarrierEquation& one : equations) one.agrees = false;
            return;
        }
        std::ranges::max_element(equations, {}, [&](const CarrierEquation& one) {
            return one.agrees ? fit.outlying(one.row, one.residual_m, one.variance_m2) : -1;
        })->agrees = false;
    }
}

} // namespace locus::gnss
