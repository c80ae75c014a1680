// How likely each particle makes what an anchor said of its wearer.
#include "fusion/estimators/walker_particles.h"

#include <algorithm>
#include <cmath>

namespace locus {

WalkerParticles::Expected WalkerParticles::expect(const uwb::Sighting& sighting) const noexcept {
    const Eigen::Vector3d place = walk_.place_site_m();
    const Eigen::Vector3d gradient = uwb::gradient(sighting, *site_, place);
    return {sighting.value_m - uwb::predicted_m(sighting, *site_, place), gradient.head<2>(), gradient.z()};
}

/// Of the measurement against a place. An anchor heard faster than its error changes says the same again.
double WalkerParticles::variance_m2(const uwb::Sighting& sighting, double climb, Timestamp time) noexcept {
    auto& heard = state_.heard[static_cast<std::size_t>(sighting.plus)];
    const double since_s = heard ? std::max(1e-3, to_s(time - *heard)) : settings_.anchor_error_time_s;
    heard = time;
    const double held = settings_.anchor_error_sigma_m * settings_.anchor_error_sigma_m * (sighting.is_range() ? 1 : 2);
    const double repeated = std::max(1.0, settings_.anchor_error_time_s / since_s);
    const double by_height = climb * settings_.height_sigma_m;
    return double{sighting.sigma_m} * double{sighting.sigma_m} + held * repeated + by_height * by_height;
}

filter::ParticleNoise WalkerParticles::noise(double variance_m2) const noexcept {
    filter::ParticleNoise noise;
    noise.sigma_m = std::sqrt(variance_m2);
    noise.outlier_share = settings_.blocked_share;
    noise.long_tail_m = noise.short_tail_m = settings_.blocked_excess_m + noise.sigma_m;
    return noise;
}

Verdict WalkerParticles::weigh(const uwb::Sighting& sighting, Timestamp time) noexcept {
    const Expected expected = expect(sighting);
    const double variance = variance_m2(sighting, expected.climb, time);
    const double spread = expected.gradient.dot(cloud().covariance().topLeftCorner<2, 2>() * expected.gradient);
    const double sigma = std::sqrt(spread + variance);
    Verdict verdict = verdict_of(expected.innovation_m, sigma, gate_in_sigma_);
    auto& gate = state_.gates.gate(sighting.plus, time);
    if (!gate.passes(expected.innovation_m / sigma, gate_in_sigma_,
                     static_cast<std::uint32_t>(settings_.gate_patience)))
        return kept_out(verdict);
    filter::ParticleNoise noise = this->noise(variance);
    const Vec3& plus = site_->anchors[static_cast<std::size_t>(sighting.plus)].position_site_m;
    if (sighting.is_range()) {
        noise.short_tail_m = noise.sigma_m; // nothing makes a path much shorter
        particles().weigh_range(walk_.local(plus), plus[2] - settings_.height_m, sighting.value_m, noise);
    } else {
        const Vec3& minus = site_->anchors[static_cast<std::size_t>(sighting.minus)].position_site_m;
        particles().weigh_difference(walk_.local(minus), minus[2] - settings_.height_m, walk_.local(plus),
                                     plus[2] - settings_.height_m, sighting.value_m, noise);
    }
    if (!settle()) verdict.reason = Exclusion::innovation_too_large;
    return verdict;
}

} // namespace locus
