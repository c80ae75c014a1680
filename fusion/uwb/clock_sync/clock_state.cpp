#include "fusion/uwb/clock_sync/clock_state.h"

#include "fusion/uwb/ticks.h"

#include <cmath>

namespace locus::uwb {
namespace {

constexpr double two_crystals = 2;

double square(double x) { return x * x; }

Eigen::Matrix3d transition(double dt_s) {
    Eigen::Matrix3d f;
    f << 1, dt_s, dt_s * dt_s / 2, 0, 1, dt_s, 0, 0, 1;
    return f;
}

/// White noise of the drift's change, summed up over dt into drift, rate and offset; and that of the rate into the
/// offset.
Eigen::Matrix3d noise(double dt_s, const CrystalModel& crystal) {
    const double t = std::abs(dt_s), t2 = t * t, t3 = t2 * t;
    Eigen::Matrix3d q;
    q << t3 * t2 / 20, t2 * t2 / 8, t3 / 6, t2 * t2 / 8, t3 / 3, t2 / 2, t3 / 6, t2 / 2, t;
    q *= crystal.drift_walk;
    q(0, 0) += crystal.offset_walk * t;
    return q;
}

} // namespace

CrystalModel::CrystalModel(const ClockSyncSettings& s)
    : rate_variance(two_crystals * square(s.crystal_tolerance_ppm * 1e-6 / tick_s)),
      drift_variance(two_crystals * square(s.crystal_drift_ppm_per_s * 1e-6 / tick_s)),
      offset_walk(two_crystals * square(s.crystal_noise_ppb * 1e-9 / tick_s)),
      drift_walk(drift_variance / s.crystal_drift_time_s), arrival_variance(square(s.arrival_sigma_m / tick_m)) {}

ClockState ClockState::first(const CrystalModel& crystal) {
    ClockState state;
    state.covariance.diagonal() << crystal.arrival_variance, crystal.rate_variance, crystal.drift_variance;
    return state;
}

ClockState ClockState::after(double dt_s, const CrystalModel& crystal) const {
    const Eigen::Matrix3d f = transition(dt_s);
    ClockState later;
    later.mean = f * mean;
    later.covariance = f * covariance * f.transpose() + noise(dt_s, crystal);
    return later;
}

double ClockState::covariance_with_later_offset(double dt_s) const {
    return covariance.row(0).dot(transition(dt_s).row(0));
}

void ClockState::update(double innovation_ticks, double measured_variance) {
    const double innovation_variance = covariance(0, 0) + measured_variance;
    const Eigen::Vector3d gain = covariance.col(0) / innovation_variance;
    Eigen::Matrix3d rest = Eigen::Matrix3d::Identity();
    rest.col(0) -= gain;
    mean += gain * innovation_ticks;
    covariance = rest * covariance * rest.transpose() + measured_variance * gain * gain.transpose();
}

} // namespace locus::uwb
