#include "fusion/estimators/range_ekf.h"

#include "fusion/filter/scalar_update.h"
#include "fusion/geometry/vector.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace locus {
namespace {

using filter::TrackState;

constexpr double kind_memory_s = 1;

filter::TrackModel track_model(const RangeEkfSettings& s) {
    return {{s.acceleration_sigma_mps2, s.acceleration_time_s}, s.speed_sigma_mps, s.planar};
}

CarriedErrors carried_errors(const RangeEkfSettings& s) {
    return {{s.anchor_error_sigma_m, s.anchor_error_time_s}, {s.common_range_error_sigma_m, no_limit}};
}

uwb::EpochSettings epoch_settings(const RangeEkfSettings& s) {
    uwb::EpochSettings epoch;
    epoch.window_s = s.start_window_s;
    epoch.speed_mps = s.speed_sigma_mps;
    epoch.held_range_sigma_m = std::hypot(s.anchor_error_sigma_m, s.common_range_error_sigma_m);
    epoch.held_difference_sigma_m = std::numbers::sqrt2 * s.anchor_error_sigma_m;
    epoch.solve.planar = s.planar;
    epoch.solve.height_site_m = s.height_m;
    return epoch;
}

Missing missing_for(Exclusion reason) {
    return reason == Exclusion::geometry_too_few ? Missing::anchors : Missing::geometry;
}

} // namespace

RangeEkf::RangeEkf(const Site& site, const RangeEkfSettings& settings)
    : site_(&site), settings_(settings), gate_in_sigma_(filter::gate_in_sigma(settings.gate_false_alarm)),
      start_anew_cost_(gate_in_sigma_ * gate_in_sigma_), reader_(site, settings), errors_(carried_errors(settings)),
      track_(track_model(settings)), epoch_(site, epoch_settings(settings)), robust_(settings.robust_scale),
      gates_(site.anchors.size()) {}

Verdict RangeEkf::update(const Measurement& measurement) noexcept {
    const RangeReader::Reading reading = reader_.read(measurement);
    if (reading.reason != Exclusion::none) return {reading.reason};
    return take(reading.sighting, measurement.time);
}

Verdict RangeEkf::take(const uwb::Sighting& sighting, Timestamp time) noexcept {
    epoch_.keep(sighting, time);
    const bool forgotten = missing_ == Missing::nothing && to_s(time - used_time_) > settings_.forget_after_s;
    if (missing_ != Missing::nothing || forgotten) return start(time);

    const double dt_s = to_s(time - time_);
    track_.predict(dt_s);
    time_ = time;
    const Verdict verdict = weigh(sighting);
    count_refusal(verdict.reason != Exclusion::none, dt_s);
    if (verdict.reason == Exclusion::none) {
        used_time_ = time;
        kind_used_[sighting.is_range() ? 0 : 1] = time;
    } else {
        start_again_if_lost(time);
    }
    return verdict;
}

Verdict RangeEkf::start(Timestamp time) noexcept {
    const uwb::EpochKeeper::Answer answer = epoch_.solve(time, track_.position_m());
    if (answer.agrees) {
        start_at(answer.fix, time);
        return {};
    }
    if (missing_ == Missing::nothing) return {Exclusion::waiting_for_start};
    missing_ = answer.fix.reason == Exclusion::none ? Missing::agreement : missing_for(answer.fix.reason);
    return {answer.fix.reason == Exclusion::none ? Exclusion::waiting_for_start : answer.fix.reason};
}

void RangeEkf::start_at(const uwb::Fix& fix, Timestamp time) noexcept {
    if (missing_ == Missing::nothing) ++reset_count_;
    track_.start(vector(fix.position_site_m), Eigen::Matrix3d(fix.covariance_m2.data()));
    time_ = used_time_ = time;
    refused_share_ = 0;
    missing_ = Missing::nothing;
}

Verdict RangeEkf::weigh(const uwb::Sighting& sighting) noexcept {
    const RangeExpectation expected = expect(sighting, *site_, errors_, track_);
    const auto prediction = filter::predict_scalar(track_.covariance, expected.jacobian);
    const double variance = double{sighting.sigma_m} * double{sighting.sigma_m};
    const double innovation_variance = prediction.state_variance + variance;
    const double in_sigma = expected.innovation_m / std::sqrt(innovation_variance);

    Verdict verdict;
    verdict.innovation = static_cast<float>(expected.innovation_m);
    verdict.innovation_sigma = static_cast<float>(std::sqrt(innovation_variance));
    verdict.test_ratio = static_cast<float>(std::abs(in_sigma) / gate_in_sigma_);
    const auto patience = static_cast<std::uint32_t>(settings_.gate_patience);
    if (!gates_[static_cast<std::size_t>(sighting.plus)].passes(in_sigma, gate_in_sigma_, patience)) {
        verdict.reason = Exclusion::innovation_too_large;
        verdict.weight = 0;
        return verdict;
    }
    const filter::Share share = robust_.weigh(in_sigma);
    verdict.weight = static_cast<float>(share.step);
    filter::update_scalar(track_.state, track_.covariance, prediction, expected.innovation_m, variance, share);
    return verdict;
}

void RangeEkf::count_refusal(bool refused, double dt_s) noexcept {
    const double fresh = -std::expm1(-dt_s / settings_.lost_after_s);
    refused_share_ += fresh * ((refused ? 1.0 : 0.0) - refused_share_);
}

/// Most measurements refused may mean a bad site or a filter in the wrong place: it moves only when the last window
/// agrees on a place and fits there far better than here.
void RangeEkf::start_again_if_lost(Timestamp time) noexcept {
    if (refused_share_ < 0.5) return;
    const uwb::EpochKeeper::Answer answer = epoch_.solve(time, track_.position_m());
    if (answer.agrees && answer.cost_of_other - answer.fix.cost > start_anew_cost_) start_at(answer.fix, time);
}

Estimate RangeEkf::predict(Timestamp time) const noexcept {
    Estimate estimate;
    estimate.time = time;
    estimate.reset_count = reset_count_;
    estimate.missing = missing_;
    for (std::size_t kind = 0; kind < kind_used_.size(); ++kind)
        if (const auto& used = kind_used_[kind]; used && to_s(time - *used) <= kind_memory_s)
            estimate.kinds_used |= 1u << kind;
    if (missing_ != Missing::nothing) return estimate;

    TrackState track = track_;
    track.predict(std::max(0.0, to_s(time - time_)));
    const auto place = [](int i) { return TrackState::place(i % 3, i / 3); };
    for (int i = 0; i < 3; ++i) {
        estimate.position_site_m[i] = track.state(place(i));
        estimate.velocity_site_mps[i] = track.state(place(i + 3));
    }
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) estimate.covariance[6 * i + j] = track.covariance(place(i), place(j));
    return estimate;
}

std::unique_ptr<Estimator> make_range_ekf(const Site& site, const void* settings) {
    return std::make_unique<RangeEkf>(site, *static_cast<const RangeEkfSettings*>(settings));
}

} // namespace locus
