#include "fusion/estimators/range_filter.h"

#include "fusion/estimators/nav_track.h"
#include "fusion/estimators/waiting.h"
#include "fusion/filter/scalar_update.h"
#include "fusion/filter/track_state.h"
#include "fusion/geometry/vector.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace locus {
namespace {

CarriedErrors carried_errors(const RangeEkfSettings& s) {
    return {{s.anchor_error_sigma_m, s.anchor_error_time_s},
            {s.anchor_offset_sigma_m, s.anchor_offset_time_s},
            {s.common_range_error_sigma_m, no_limit}};
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

} // namespace

template <class Track>
RangeFilter<Track>::RangeFilter(const Site& site, const RangeEkfSettings& settings, Track track)
    : track_(std::move(track)), site_(&site), settings_(settings), forget_after_s_(settings.forget_after_s),
      gate_in_sigma_(filter::gate_in_sigma(settings.gate_false_alarm)),
      start_anew_cost_(gate_in_sigma_ * gate_in_sigma_), reader_(site, settings), errors_(carried_errors(settings)),
      epoch_(site, epoch_settings(settings)), robust_(settings.robust_scale), gates_(site.anchors.size()) {}

template <class Track>
Verdict RangeFilter<Track>::update(const Measurement& measurement) noexcept {
    const RangeReader::Reading reading = reader_.read(measurement);
    if (reading.reason != Exclusion::none) return {reading.reason};
    return take(reading.sighting, measurement);
}

template <class Track>
void RangeFilter<Track>::move_to(Timestamp time) noexcept {
    track_.predict(to_s(time - time_));
    time_ = time;
}

template <class Track>
Verdict RangeFilter<Track>::take(const uwb::Sighting& sighting, const Measurement& measurement) noexcept {
    const Timestamp time = measurement.time;
    epoch_.keep(sighting, time);
    const bool forgotten = has_position() && to_s(time - used_time_) > forget_after_s_;
    if (!has_position() || forgotten) return start(time);

    move_to(time);
    const RangeExpectation<Track> expected = expect(sighting, *site_, errors_, track_);
    const double variance = double{sighting.sigma_m} * double{sighting.sigma_m};
    const Verdict verdict =
        weigh({expected.innovation_m, expected.jacobian, variance}, gates_.gate(sighting.plus, time), robust_);
    if (verdict.reason == Exclusion::none) {
        used_time_ = time;
        note_use(measurement.observation, time);
    }
    start_again_if_lost(time);
    return verdict;
}

template <class Track>
Verdict RangeFilter<Track>::start(Timestamp time) noexcept {
    const uwb::EpochKeeper::Answer answer = epoch_.solve(time, track_.antenna_site_m());
    if (answer.agrees) {
        start_at(vector(answer.fix.position_site_m), Eigen::Matrix3d(answer.fix.covariance_m2.data()), time);
        return {};
    }
    if (missing_ == Missing::nothing) return {Exclusion::waiting_for_start};
    const Waiting waiting = waiting_after(answer.fix.reason);
    missing_ = waiting.missing;
    return {waiting.reason};
}

template <class Track>
void RangeFilter<Track>::start_at(const Eigen::Vector3d& position_site_m, const Eigen::Matrix3d& covariance_m2,
                                  Timestamp time) noexcept {
    if (missing_ == Missing::nothing) ++reset_count_;
    track_.start(position_site_m, covariance_m2);
    time_ = used_time_ = time;
    gates_.begin_anew();
    missing_ = Missing::nothing;
}

template <class Track>
Verdict RangeFilter<Track>::weigh(const Scalar& scalar, filter::Gate& gate, filter::RobustGain& robust) noexcept {
    const auto prediction = filter::predict_scalar(track_.covariance, scalar.jacobian);
    const double innovation_sigma = std::sqrt(prediction.state_variance + scalar.variance);
    const double in_sigma = scalar.innovation / innovation_sigma;

    Verdict verdict = verdict_of(scalar.innovation, innovation_sigma, gate_in_sigma_);
    const auto patience = static_cast<std::uint32_t>(settings_.gate_patience);
    if (!gate.passes(in_sigma, gate_in_sigma_, patience)) return kept_out(verdict);
    const filter::Share share = robust.weigh(in_sigma);
    verdict.weight = static_cast<float>(share.step);
    track_.correct(prediction, scalar.innovation, scalar.variance, share);
    return verdict;
}

/// Most anchors refused may mean a bad site or a filter in the wrong place: it moves only when the last window
/// agrees on a place and fits there far better than here.
template <class Track>
void RangeFilter<Track>::start_again_if_lost(Timestamp time) noexcept {
    if (!gates_.most_in_doubt(time, settings_.lost_after_s)) return;
    const uwb::EpochKeeper::Answer answer = epoch_.solve(time, track_.antenna_site_m());
    if (answer.agrees && answer.cost_of_other - answer.fix.cost > start_anew_cost_)
        start_at(vector(answer.fix.position_site_m), Eigen::Matrix3d(answer.fix.covariance_m2.data()), time);
}

template <class Track>
Estimate RangeFilter<Track>::predict(Timestamp time) const noexcept {
    Estimate estimate;
    estimate.time = time;
    estimate.reset_count = reset_count_;
    estimate.missing = missing_;
    estimate.kinds_used = used_.lately(time);
    if (!has_position()) return estimate;

    Track track = track_;
    track.predict(std::max(0.0, to_s(time - time_)));
    track.report(estimate);
    return estimate;
}

template class RangeFilter<filter::TrackState>;
template class RangeFilter<NavTrack>;

} // namespace locus
