#include "fusion/inertial/rest.h"

#include <algorithm>
#include <cmath>

namespace locus::inertial {
namespace {

constexpr double window_s = 0.5;
/// Twice what MEMS sensors of the phone class show at rest at 100-250 Hz (BMI088: 0.014 deg/s/rtHz, 175 ug/rtHz), and a
/// fifth of what a hand that tries to hold still shows.
constexpr double most_force_sigma_mps2 = 0.08, most_rate_sigma_radps = 0.01;
/// No gyroscope in use is worse; a steady turn on a turntable is not rest.
constexpr double most_bias_radps = 0.1;

} // namespace

void Rest::carry(const Rates& rates, double dt_s) noexcept {
    if (watched_s_ == 0) {
        mean_force_mps2_ = rates.specific_force_mps2;
        mean_rate_radps_ = rates.angular_rate_radps;
    }
    watched_s_ += dt_s;
    const double share = dt_s / std::clamp(watched_s_, dt_s, window_s);
    const auto learn = [share](Eigen::Vector3d& mean, double& variance, const Eigen::Vector3d& sample) {
        const Eigen::Vector3d off = sample - mean;
        mean += share * off;
        variance += share * (off.squaredNorm() / 3 - variance);
    };
    learn(mean_force_mps2_, force_variance_, rates.specific_force_mps2);
    learn(mean_rate_radps_, rate_variance_, rates.angular_rate_radps);
    if (is_at_rest()) bias_radps_ = mean_rate_radps_;
}

bool Rest::is_at_rest() const noexcept {
    return watched_s_ >= window_s && force_variance_ < most_force_sigma_mps2 * most_force_sigma_mps2 &&
           rate_variance_ < most_rate_sigma_radps * most_rate_sigma_radps && mean_rate_radps_.norm() < most_bias_radps;
}

} // namespace locus::inertial
