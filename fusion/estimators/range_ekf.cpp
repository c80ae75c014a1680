#include "fusion/estimators/range_ekf.h"

#include "fusion/filter/robust_weight.h"
#include "fusion/filter/scalar_update.h"

#include <algorithm>
#include <cmath>

namespace locus {
namespace {

using filter::TrackState;

/// No device is better than this, whatever it says: a zero sigma would make the filter sure for ever.
constexpr double least_sigma_m = 1e-3;
/// Keys of wandering errors: anchors are called by their index, and one more is common to all ranges.
constexpr std::int32_t common_range_error = -1;
constexpr double kind_memory_s = 1;

double noise_m(float stated_m, double otherwise_m) {
    const double sigma_m = std::isfinite(stated_m) ? double{stated_m} : otherwise_m;
    return std::max(sigma_m, least_sigma_m);
}

filter::TrackModel track_model(const RangeEkfSettings& s) {
    return {{s.acceleration_sigma_mps2, s.acceleration_time_s}, s.speed_sigma_mps, s.planar};
}

uwb::EpochSettings epoch_settings(const RangeEkfSettings& s) {
    uwb::EpochSettings epoch;
    epoch.window_s = s.start_window_s;
    epoch.speed_mps = s.speed_sigma_mps;
    epoch.held_range_sigma_m = std::hypot(s.anchor_error_sigma_m, s.common_range_error_sigma_m);
    epoch.held_difference_sigma_m = std::sqrt(2.0) * s.anchor_error_sigma_m;
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
      start_anew_cost_(gate_in_sigma_ * gate_in_sigma_), track_(track_model(settings)),
      epoch_(site, epoch_settings(settings)), gates_(site.anchors.size()) {}

Verdict RangeEkf::update(const Measurement& measurement) noexcept {
    Reading reading;
    if (const auto* range = std::get_if<Range>(&measurement.observation))
        reading = read(*range);
    else if (const auto* difference = std::get_if<RangeDifference>(&measurement.observation))
        reading = read(*difference);
    else
        reading.reason = Exclusion::unsupported_kind;
    if (reading.reason != Exclusion::none) return {reading.reason};
    return take(reading.sighting, measurement.time);
}

RangeEkf::Reading RangeEkf::read(const Range& range) const noexcept {
    const std::int16_t anchor = index_of(range.anchor);
    if (anchor == uwb::Sighting::nobody) return {{}, Exclusion::unknown_source};
    if (!std::isfinite(range.range_m)) return {{}, Exclusion::not_finite};
    if (std::abs(range.range_m) > settings_.max_range_m) return {{}, Exclusion::out_of_reach};
    if (range.line_of_sight == LineOfSight::blocked && !settings_.use_blocked) return {{}, Exclusion::reported_blocked};
    const Anchor& known = site_->anchors[static_cast<std::size_t>(anchor)];
    const double otherwise_m = std::isfinite(known.sigma_m) ? known.sigma_m : settings_.range_sigma_m;
    return {{anchor, uwb::Sighting::nobody, static_cast<float>(noise_m(range.sigma_m, otherwise_m)),
             range.range_m - known.range_bias_m}};
}

RangeEkf::Reading RangeEkf::read(const RangeDifference& difference) const noexcept {
    const std::int16_t a = index_of(difference.anchor_a), b = index_of(difference.anchor_b);
    if (a == uwb::Sighting::nobody || b == uwb::Sighting::nobody || a == b) return {{}, Exclusion::unknown_source};
    if (!std::isfinite(difference.difference_m)) return {{}, Exclusion::not_finite};
    if (std::abs(difference.difference_m) > settings_.max_range_m) return {{}, Exclusion::out_of_reach};
    if (difference.line_of_sight == LineOfSight::blocked && !settings_.use_blocked)
        return {{}, Exclusion::reported_blocked};
    const double bias_m = site_->anchors[static_cast<std::size_t>(b)].range_bias_m -
                          site_->anchors[static_cast<std::size_t>(a)].range_bias_m;
    return {{b, a, static_cast<float>(noise_m(difference.sigma_m, difference_sigma_m(a, b))),
             difference.difference_m - bias_m}};
}

std::int16_t RangeEkf::index_of(Address anchor) const noexcept {
    const Anchor* found = site_->find_anchor(anchor);
    return found ? static_cast<std::int16_t>(found - site_->anchors.data()) : uwb::Sighting::nobody;
}

double RangeEkf::difference_sigma_m(std::int16_t a, std::int16_t b) const noexcept {
    const double a_m = site_->anchors[static_cast<std::size_t>(a)].sigma_m;
    const double b_m = site_->anchors[static_cast<std::size_t>(b)].sigma_m;
    return std::isfinite(a_m) && std::isfinite(b_m) ? std::hypot(a_m, b_m) : settings_.range_difference_sigma_m;
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
    const Vec3& p = fix.position_site_m;
    track_.start({p[0], p[1], p[2]}, Eigen::Matrix3d(fix.covariance_m2.data()));
    time_ = used_time_ = time;
    refused_share_ = 0;
    missing_ = Missing::nothing;
}

RangeEkf::Expectation RangeEkf::expect(const uwb::Sighting& sighting) noexcept {
    const filter::WanderModel held{settings_.anchor_error_sigma_m, settings_.anchor_error_time_s};
    const filter::WanderModel common{settings_.common_range_error_sigma_m, no_limit};
    const bool ranges = sighting.is_range();
    std::array<int, 2> places{-1, -1};
    if (held.sigma > 0) places[0] = track_.wanderer(sighting.plus, held);
    if (ranges && common.sigma > 0) places[1] = track_.wanderer(common_range_error, common);
    if (!ranges && held.sigma > 0) places[1] = track_.wanderer(sighting.minus, held);

    Expectation expectation;
    expectation.jacobian.setZero(track_.size());
    const Eigen::Vector3d gradient = uwb::gradient(sighting, *site_, track_.position_m());
    for (int axis = 0; axis < 3; ++axis) expectation.jacobian(TrackState::place(axis, 0)) = gradient(axis);
    double predicted_m = uwb::predicted_m(sighting, *site_, track_.position_m());
    for (int i = 0; i < 2; ++i) {
        if (places[i] < 0) continue;
        const double sign = i == 1 && !ranges ? -1 : 1;
        expectation.jacobian(places[i]) = sign;
        predicted_m += sign * track_.state(places[i]);
    }
    expectation.innovation_m = sighting.value_m - predicted_m;
    return expectation;
}

Verdict RangeEkf::weigh(const uwb::Sighting& sighting) noexcept {
    const Expectation expected = expect(sighting);
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
    const double weight = filter::cauchy_weight(in_sigma, settings_.robust_scale);
    verdict.weight = static_cast<float>(weight);
    filter::update_scalar(track_.state, track_.covariance, prediction, expected.innovation_m,
                          filter::weakened_variance(innovation_variance, prediction.state_variance, weight));
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
        if (kind_used_[kind] && to_s(time - *kind_used_[kind]) <= kind_memory_s) estimate.kinds_used |= 1u << kind;
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
