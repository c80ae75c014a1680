#include "fusion/estimators/epoch_gatherer.h"

#include "fusion/estimators/waiting.h"

#include <numbers>

namespace locus {
namespace {

uwb::EpochSettings keeping(const EpochEstimatorSettings& s) {
    uwb::EpochSettings epoch;
    epoch.window_s = s.epoch_s;
    epoch.speed_mps = s.speed_sigma_mps;
    epoch.held_range_sigma_m = s.anchor_error_sigma_m;
    epoch.held_difference_sigma_m = std::numbers::sqrt2 * s.anchor_error_sigma_m;
    epoch.solve.planar = s.planar;
    epoch.solve.height_site_m = s.height_m;
    return epoch;
}

} // namespace

EpochGatherer::EpochGatherer(const Site& site, const EpochEstimatorSettings& settings, Reach reach)
    : reader_(site, settings), keeper_(site, keeping(settings)), epoch_(duration_from_s(settings.epoch_s)),
      reach_(reach) {}

bool EpochGatherer::is_over(const uwb::Sighting& sighting, Timestamp time) const noexcept {
    if (!opened_ || time - *opened_ >= epoch_) return true;
    return fixed_ && *fixed_ >= *opened_ && keeper_.heard(sighting, *opened_);
}

EpochGatherer::News EpochGatherer::take(const Measurement& measurement) noexcept {
    const RangeReader::Reading reading = reader_.read(measurement);
    if (reading.reason != Exclusion::none) return {reading.reason, false, {}};
    const Timestamp time = measurement.time;
    News news;
    news.opens_epoch = is_over(reading.sighting, time);
    if (news.opens_epoch) opened_ = time;
    keeper_.keep(reading.sighting, time);
    const Timestamp since = reach_ == Reach::epoch ? opened_.value_or(time) : time - epoch_;
    const uwb::EpochKeeper::Answer answer = keeper_.solve_since(since, time, Eigen::Vector3d::Zero());
    news.reason = judge(answer, measurement);
    if (answer.agrees) news.fix = answer.fix;
    return news;
}

/// What waits in an epoch for the others counts as used, unless epochs have come to nothing for a while.
Exclusion EpochGatherer::judge(const uwb::EpochKeeper::Answer& answer, const Measurement& measurement) noexcept {
    const Timestamp time = measurement.time;
    if (answer.agrees) {
        fixed_ = time;
        missing_ = Missing::nothing;
    } else if (missing_ != Missing::nothing) {
        const Waiting waiting = waiting_after(answer.fix.reason);
        missing_ = waiting.missing;
        return waiting.reason;
    } else if (answer.fix.reason == Exclusion::none) {
        return Exclusion::innovation_too_large;
    } else if (time - *fixed_ > 2 * epoch_) {
        return answer.fix.reason;
    }
    used_.note(measurement.observation, time);
    return Exclusion::none;
}

void EpochGatherer::describe(Timestamp time, Estimate& estimate) const noexcept {
    estimate.time = time;
    estimate.missing = missing_;
    estimate.kinds_used = used_.lately(time);
}

} // namespace locus
