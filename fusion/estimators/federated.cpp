#include "fusion/estimators/federated.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace locus {
namespace {

/// With the target's motion as the local filter of `share` of the information must take it (filter/information_sum.h).
FederatedSettings shared(FederatedSettings settings, double share) {
    settings.velocity_walk /= std::sqrt(share);
    settings.speed_sigma_mps /= std::sqrt(share);
    return settings;
}

/// Square of the distance that two coordinates together exceed by chance.
double squared_gate(double false_alarm) { return -2 * std::log(false_alarm); }

FootFilterModel foot_model(const FederatedSettings& settings) {
    FootFilterModel model;
    model.motion = fix_filter_model(shared(settings, 1 - settings.uwb_share));
    model.motion.carried_share = settings.foot_error_share;
    model.motion.carried_time_s = settings.foot_error_time_s;
    model.gate_in_sigma = std::sqrt(squared_gate(settings.gate_false_alarm));
    model.beside_sigma_m = settings.foot_error_sigma_m;
    model.patience = duration_from_s(settings.gate_patience_s);
    model.memory = duration_from_s(settings.restart_after_s);
    return model;
}

constexpr double chance_of_contradiction = 0.01;

} // namespace

Federated::Federated(const Site& site, const FederatedSettings& settings)
    : settings_(settings), uwb_(site, shared(settings, settings.uwb_share)), fresh_uwb_(uwb_),
      feet_(foot_model(settings)), chance_(squared_gate(chance_of_contradiction)) {}

Verdict Federated::update(const Measurement& measurement) noexcept {
    if (const auto* foot = std::get_if<FootPoint>(&measurement.observation)) return see(*foot, measurement);
    return hear(measurement);
}

Verdict Federated::see(const FootPoint& foot, const Measurement& measurement) noexcept {
    const Verdict verdict = feet_.take(foot, measurement.time);
    if (verdict.reason == Exclusion::none) seen_.note(measurement.observation, measurement.time);
    return verdict;
}

Verdict Federated::hear(const Measurement& measurement) noexcept {
    if (heard_ && to_s(measurement.time - *heard_) > settings_.restart_after_s) {
        uwb_.copy_from(fresh_uwb_);
        heard_.reset();
    }
    const Verdict verdict = uwb_.update(measurement);
    if (verdict.reason == Exclusion::none) heard_ = measurement.time;
    return verdict;
}

filter::PlaneKnowledge Federated::master(const filter::PlaneKnowledge& heard,
                                         const filter::PlaneKnowledge& seen) const noexcept {
    filter::PlaneKnowledge sum = filter::sum_of_information(heard, seen);
    sum.covariance *= std::max(1.0, filter::contradiction(heard, seen) / chance_);
    return sum;
}

Estimate Federated::predict(Timestamp time) const noexcept {
    Estimate estimate = uwb_.predict(time);
    estimate.kinds_used |= seen_.lately(time);
    estimate.reset_count += feet_.jumps();
    const bool hears = estimate.missing == Missing::nothing;
    if (!hears && !feet_.is_started()) return estimate;
    filter::PlaneKnowledge known = hears ? plane_of(estimate) : feet_.at(time);
    if (hears && feet_.is_started()) known = master(known, feet_.at(time));
    write(known, estimate);
    return estimate;
}

void Federated::write(const filter::PlaneKnowledge& known, Estimate& estimate) const noexcept {
    constexpr std::array<int, 4> plane{0, 1, 3, 4};
    estimate.missing = Missing::nothing;
    estimate.position_site_m = {known.state(0), known.state(1), settings_.height_m};
    estimate.velocity_site_mps = {known.state(2), known.state(3), 0};
    Eigen::Map<Eigen::Matrix<double, 6, 6>> covariance(estimate.covariance.data());
    covariance.setZero();
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) covariance(plane[i], plane[j]) = known.covariance(i, j);
    covariance(2, 2) = settings_.tag_height_sigma_m * settings_.tag_height_sigma_m;
}

std::unique_ptr<Estimator> make_federated(const Site& site, const void* settings) {
    return std::make_unique<Federated>(site, *static_cast<const FederatedSettings*>(settings));
}

} // namespace locus
