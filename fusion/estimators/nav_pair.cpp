#include "fusion/estimators/nav_pair.h"

namespace locus {
namespace {

/// The models mix so often: a person or vehicle does not change its way faster.
constexpr double mix_every_s = 0.1;

InertialEkfSettings steadily(InertialEkfSettings settings) {
    settings.acceleration_sigma_mps2 = settings.steady_acceleration_sigma_mps2;
    settings.acceleration_time_s = settings.steady_acceleration_time_s;
    return settings;
}

} // namespace

/// Mean and covariance of the mixture of two estimates of one time.
Estimate mixed(const Estimate& a, const Estimate& b, double share_of_b) {
    Estimate mix = share_of_b < 0.5 ? a : b;
    std::array<double, 6> apart{};
    for (std::size_t i = 0; i < 3; ++i) {
        apart[i] = b.position_site_m[i] - a.position_site_m[i];
        apart[i + 3] = b.velocity_site_mps[i] - a.velocity_site_mps[i];
        mix.position_site_m[i] = a.position_site_m[i] + share_of_b * apart[i];
        mix.velocity_site_mps[i] = a.velocity_site_mps[i] + share_of_b * apart[i + 3];
    }
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
            mix.covariance[6 * i + j] = (1 - share_of_b) * a.covariance[6 * i + j] +
                                        share_of_b * b.covariance[6 * i + j] +
                                        share_of_b * (1 - share_of_b) * apart[i] * apart[j];
    mix.orientation_xyzw = b.orientation_xyzw;
    return mix;
}

NavPair::NavPair(const Site& site, const InertialEkfSettings& settings)
    : brisk_(site, settings), steady_(site, steadily(settings)), models_(settings.steady_for_s),
      is_pair_(settings.steady_acceleration_sigma_mps2 > 0) {}

Verdict NavPair::update(const Measurement& measurement, bool both) noexcept {
    return hear([&](NavFilter& filter) { return filter.update(measurement); }, measurement.time, both);
}

Verdict NavPair::see(const AlignedPlace& place, const Measurement& odometry, bool both) noexcept {
    return hear([&](NavFilter& filter) { return filter.see(place, odometry); }, odometry.time, both);
}

template <class Tell>
Verdict NavPair::hear(const Tell& tell, Timestamp time, bool both) noexcept {
    const Verdict brisk = tell(brisk_);
    const bool pairs = is_pair_ && both && brisk_.has_position();
    if (!pairs || !paired_ || steady_.reset_count() != brisk_.reset_count()) {
        if (pairs) steady_.go_with(brisk_);
        paired_ = pairs;
        mixed_ = time;
        return brisk;
    }
    learn(brisk, tell(steady_));
    interact(time);
    return brisk;
}

void NavPair::learn(const Verdict& brisk, const Verdict& steady) noexcept {
    if (brisk.reason != Exclusion::none || !std::isfinite(brisk.innovation) || !std::isfinite(steady.innovation))
        return;
    const double spread = brisk_.innovation_spread();
    models_.learn({brisk.innovation, steady.innovation},
                  {spread * brisk.innovation_sigma, spread * steady.innovation_sigma});
}

void NavPair::interact(Timestamp time) noexcept {
    const double dt_s = to_s(time - mixed_);
    if (dt_s < mix_every_s) return;
    mixed_ = time;
    if (!brisk_.interact(steady_, models_.pass(dt_s))) steady_.go_with(brisk_);
}

Estimate NavPair::predict(Timestamp time) const noexcept {
    const Estimate brisk = brisk_.predict(time);
    return paired_ ? mixed(brisk, steady_.predict(time), models_.share()) : brisk;
}

} // namespace locus
