#include "fusion/estimators/gnss_start.h"

#include "fusion/filter/robust_gain.h"
#include "fusion/geometry/vector.h"
#include "fusion/gnss/least_squares.h"
#include "fusion/gnss/signals.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace locus {
namespace {

constexpr double start_moment_s = 0.15; ///< satellites of one epoch come together; a car moves 5 m in it
constexpr double start_scale = 3;       ///< sigma
constexpr double start_agreement = 0.6; ///< mean robust weight
constexpr double worst_start_m = 1000;  ///< satellites that stand in a line give no place
constexpr double no_rate_sigma_mps = 1e3;

constexpr int clocks_at = 3, place_unknowns = clocks_at + gnss::clock_count, rate_unknowns = 4;

template <int N>
struct StartEquation {
    Eigen::Matrix<double, N, 1> line;
    double value;
    double sigma;
};

template <int N>
struct StartFit {
    Eigen::Matrix<double, N, 1> step = Eigen::Matrix<double, N, 1>::Zero();
    Eigen::Matrix<double, N, N> covariance;
    double agreement = 0;
};

/// One step with the weights that the residuals of the last one give; an unknown in no equation stays what it is.
template <int N, class Equation>
bool weigh_and_solve(StartFit<N>& fit, std::size_t count, const Equation& equation, bool first) {
    gnss::LeastSquares<N> equations;
    Eigen::Matrix<double, N, 1> told = Eigen::Matrix<double, N, 1>::Zero();
    double weights = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const StartEquation<N> one = equation(i);
        const double left = (one.value - one.line.dot(fit.step)) / one.sigma;
        const double weight = first ? 1 : filter::cauchy_weight(left, start_scale);
        equations.add(one.line, one.value, one.sigma * one.sigma / weight);
        told += one.line.cwiseAbs();
        weights += weight;
    }
    for (int i = 0; i < N; ++i)
        if (told(i) == 0) equations.hold(i);
    if (equations.redundancy() < 0 || !equations.solve()) return false;
    fit = {equations.step(), equations.covariance(), weights / static_cast<double>(count)};
    return true;
}

template <int N, class Equation>
std::optional<StartFit<N>> fit_start(std::size_t count, const Equation& equation) {
    constexpr int iterations = 5;
    StartFit<N> fit;
    for (int i = 0; i < iterations; ++i)
        if (!weigh_and_solve(fit, count, equation, i == 0)) return std::nullopt;
    return fit;
}

/// The satellites of a moment, seen from a place.
class StartView {
  public:
    StartView(const GnssInsObservations& observations, std::span<const SatelliteRange* const> satellites)
        : observations_(observations), satellites_(satellites), place_m_(observations.earth().ecef_m({0, 0, 0})) {}

    /// Gauss-Newton from the site's origin.
    std::optional<StartFit<place_unknowns>> locate() {
        constexpr int most_steps = 8;
        constexpr double there_m = 1e-3;
        std::optional<StartFit<place_unknowns>> fit;
        for (int i = 0; i < most_steps; ++i) {
            fit = fit_start<place_unknowns>(satellites_.size(), [&](std::size_t k) { return code(k); });
            if (!fit) break;
            place_m_ += fit->step.head<3>();
            if (fit->step.head<3>().norm() < there_m) break;
        }
        return fit;
    }
    std::optional<StartFit<rate_unknowns>> velocity() const {
        return fit_start<rate_unknowns>(satellites_.size(), [&](std::size_t k) { return rate(k); });
    }
    const Eigen::Vector3d& place_m() const { return place_m_; }

  private:
    Eigen::Vector3d arm(std::size_t i) const { return vector(satellites_[i]->satellite_ecef_m) - place_m_; }
    double sine(std::size_t i) const { return std::max(0.1, arm(i).normalized().dot(place_m_.normalized())); }

    StartEquation<place_unknowns> code(std::size_t i) const {
        const SatelliteRange& range = *satellites_[i];
        Eigen::Matrix<double, place_unknowns, 1> line = Eigen::Matrix<double, place_unknowns, 1>::Zero();
        line.head<3>() = -arm(i).normalized();
        line(clocks_at + gnss::clock_of(range.constellation)) = 1;
        const double noise_m = observations_.code_sigma_m(range, sine(i));
        return {line, range.pseudorange_m - arm(i).norm(),
                std::hypot(noise_m, observations_.satellite_error_sigma_m(sine(i)))};
    }
    StartEquation<rate_unknowns> rate(std::size_t i) const {
        const SatelliteRange& range = *satellites_[i];
        const Vec3f& v = range.satellite_velocity_ecef_mps;
        const Eigen::Vector3d velocity(double{v[0]}, double{v[1]}, double{v[2]}), sight = arm(i).normalized();
        const bool told = std::isfinite(range.range_rate_mps);
        return {{-sight.x(), -sight.y(), -sight.z(), 1},
                (told ? double{range.range_rate_mps} : 0) - sight.dot(velocity),
                told ? observations_.rate_sigma_mps(range, sine(i)) : no_rate_sigma_mps};
    }

    const GnssInsObservations& observations_;
    std::span<const SatelliteRange* const> satellites_;
    Eigen::Vector3d place_m_;
};

/// Of the constellation that the state's clock is of, or of another one when that is not heard: then it is that much
/// less sure.
void put_clock(GnssInsStart& start, const StartFit<place_unknowns>& fit, int clock) {
    start.clock_offset_m = fit.step(clocks_at + clock);
    start.clock_offset_sigma_m = std::sqrt(fit.covariance(clocks_at + clock, clocks_at + clock));
    if (clock != 0) start.clock_offset_sigma_m = std::hypot(start.clock_offset_sigma_m, constellation_clock_sigma_m);
}

} // namespace

void GnssStart::keep(const SatelliteRange& range, Timestamp time) noexcept {
    const auto same = std::find_if(heard_.begin(), heard_.end(), [&](const Heard& heard) {
        return heard.range.constellation == range.constellation && heard.range.satellite == range.satellite;
    });
    const auto oldest =
        std::min_element(heard_.begin(), heard_.end(), [](const Heard& a, const Heard& b) { return a.time < b.time; });
    *(same != heard_.end() ? same : oldest) = {range, time};
}

std::optional<GnssInsStart> GnssStart::solve(const GnssInsObservations& observations, Timestamp time) const noexcept {
    std::array<const SatelliteRange*, room> used{};
    std::size_t count = 0;
    int clock = gnss::clock_count;
    for (const Heard& heard : heard_) {
        if (heard.time == Timestamp::min() || to_s(time - heard.time) > start_moment_s) continue;
        used[count++] = &heard.range;
        clock = std::min(clock, gnss::clock_of(heard.range.constellation));
    }
    StartView view(observations, std::span(used).first(count));
    const auto code = view.locate();
    if (!code || code->agreement < start_agreement) return std::nullopt;
    const auto rate = view.velocity();
    if (!rate || rate->agreement < start_agreement) return std::nullopt;
    GnssInsStart start;
    start.position_ecef_m = view.place_m();
    start.position_covariance_m2 = code->covariance.topLeftCorner<3, 3>();
    if (!(start.position_covariance_m2.trace() < worst_start_m * worst_start_m)) return std::nullopt;
    put_clock(start, *code, clock);
    start.velocity_ecef_mps = rate->step.head<3>();
    start.velocity_covariance_m2ps2 = rate->covariance.topLeftCorner<3, 3>();
    start.clock_drift_mps = rate->step(3);
    start.clock_drift_sigma_mps = std::sqrt(rate->covariance(3, 3));
    return start;
}

} // namespace locus
