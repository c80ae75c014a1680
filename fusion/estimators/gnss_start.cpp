#include "fusion/estimators/gnss_start.h"

#include "fusion/filter/robust_gain.h"
#include "fusion/geometry/vector.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace locus {
namespace {

constexpr double start_moment_s = 0.15; ///< satellites of one epoch come together; a car moves 5 m in it
constexpr double start_scale = 3;       ///< sigma
constexpr double start_agreement = 0.6;

bool shares_gps_clock(const SatelliteRange& range) {
    return range.constellation == constellation::gps || range.constellation == constellation::qzss;
}

struct StartFit {
    Eigen::Vector4d step = Eigen::Vector4d::Zero();
    Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
    double agreement = 0; ///< mean robust weight
};

/// Robust least squares over `count` equations; `row(i)` gives the i-th.
template <class Row>
std::optional<StartFit> fit_start(std::size_t count, const Row& row) {
    StartFit result;
    for (int iteration = 0; iteration < 5; ++iteration) {
        Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
        Eigen::Vector4d right = Eigen::Vector4d::Zero();
        double weights = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const auto [line, value, sigma] = row(i);
            const double weight =
                iteration == 0 ? 1 : filter::cauchy_weight((value - line.dot(result.step)) / sigma, start_scale);
            normal += weight / (sigma * sigma) * line * line.transpose();
            right += weight / (sigma * sigma) * value * line;
            weights += weight;
        }
        const Eigen::LDLT<Eigen::Matrix4d> solver(normal);
        if (solver.info() != Eigen::Success || solver.rcond() < 1e-12) return std::nullopt;
        result.step = solver.solve(right);
        result.covariance = solver.solve(Eigen::Matrix4d::Identity());
        result.agreement = weights / static_cast<double>(count);
    }
    return result;
}

struct StartEquation {
    Eigen::Vector4d line;
    double value;
    double sigma;
};

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
    for (const Heard& heard : heard_)
        if (heard.time != Timestamp::min() && to_s(time - heard.time) <= start_moment_s &&
            shares_gps_clock(heard.range))
            used[count++] = &heard.range;
    if (count < 4) return std::nullopt;

    GnssInsStart start;
    start.position_ecef_m = observations.earth().ecef_m(Eigen::Vector3d::Zero());
    std::optional<StartFit> code;
    const auto sight = [&](std::size_t i) {
        return Eigen::Vector3d(vector(used[i]->satellite_ecef_m) - start.position_ecef_m);
    };
    const auto line = [&](std::size_t i) {
        Eigen::Vector4d result;
        result << -sight(i).normalized(), 1;
        return result;
    };
    const auto sine = [&](std::size_t i) {
        return std::max(0.1, sight(i).normalized().dot(start.position_ecef_m.normalized()));
    };
    for (int step = 0; step < 8; ++step) {
        code = fit_start(count, [&](std::size_t i) {
            const double sigma_m =
                std::hypot(observations.code_sigma_m(*used[i], sine(i)), observations.satellite_error_sigma_m(sine(i)));
            return StartEquation{line(i), used[i]->pseudorange_m - sight(i).norm(), sigma_m};
        });
        if (!code) return std::nullopt;
        start.position_ecef_m += code->step.head<3>();
        start.clock_offset_m = code->step(3);
        if (code->step.head<3>().norm() < 1e-3) break;
    }
    const auto rate = fit_start(count, [&](std::size_t i) {
        const Vec3f& v = used[i]->satellite_velocity_ecef_mps;
        const Eigen::Vector3d velocity(double{v[0]}, double{v[1]}, double{v[2]});
        const double told = std::isfinite(used[i]->range_rate_mps) ? double{used[i]->range_rate_mps} : 0;
        const double sigma =
            std::isfinite(used[i]->range_rate_mps) ? observations.rate_sigma_mps(*used[i], sine(i)) : 1e3;
        return StartEquation{line(i), told - sight(i).normalized().dot(velocity), sigma};
    });
    if (!code || !rate) return std::nullopt;
    if (code->agreement < start_agreement || rate->agreement < start_agreement) return std::nullopt;
    start.position_covariance_m2 = code->covariance.topLeftCorner<3, 3>();
    start.velocity_ecef_mps = rate->step.head<3>();
    start.velocity_covariance_m2ps2 = rate->covariance.topLeftCorner<3, 3>();
    start.clock_offset_sigma_m = std::sqrt(code->covariance(3, 3));
    start.clock_drift_mps = rate->step(3);
    start.clock_drift_sigma_mps = std::sqrt(rate->covariance(3, 3));
    return start;
}

} // namespace locus
