#include "fusion/estimators/epoch_gatherer.h"

#include <numbers>

namespace locus {
namespace {

constexpr double used_lately_s = 1;

RangeEkfSettings reading(const EpochEstimatorSettings& s) {
    RangeEkfSettings settings;
    settings.range_sigma_m = s.range_sigma_m;
    settings.range_difference_sigma_m = s.range_difference_sigma_m;
    settings.max_range_m = s.max_range_m;
    settings.use_blocked = s.use_blocked;
    return settings;
}

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

/// What a pose waits for when an epoch gave none for this reason.
Missing awaited(Exclusion reason) {
    if (reason == Exclusion::none) return Missing::agreement;
    return reason == Exclusion::geometry_too_few ? Missing::anchors : Missing::geometry;
}

} // namespace

EpochGatherer::EpochGatherer(const Site& site, const EpochEstimatorSettings& settings, Reach reach)
    : reader_(site, reading(settings)), keeper_(site, keeping(settings)), epoch_(duration_from_s(settings.epoch_s)),
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
    news.reason = judge(answer, reading.sighting, time);
    if (answer.agrees) news.fix = answer.fix;
    return news;
}

/// What waits in an epoch for the others counts as used, unless epochs have come to nothing for a while.
Exclusion EpochGatherer::judge(const uwb::EpochKeeper::Answer& answer, const uwb::Sighting& sighting,
                               Timestamp time) noexcept {
    if (answer.agrees) {
        fixed_ = time;
        missing_ = Missing::nothing;
    } else if (missing_ != Missing::nothing) {
        missing_ = awaited(answer.fix.reason);
        return answer.fix.reason == Exclusion::none ? Exclusion::waiting_for_start : answer.fix.reason;
    } else if (answer.fix.reason == Exclusion::none) {
        return Exclusion::innovation_too_large;
    } else if (time - *fixed_ > 2 * epoch_) {
        return answer.fix.reason;
    }
    kind_used_[sighting.is_range() ? 0 : 1] = time;
    return Exclusion::none;
}

void EpochGatherer::describe(Timestamp time, Estimate& estimate) const noexcept {
    estimate.time = time;
    estimate.missing = missing_;
    for (std::size_t kind = 0; kind < kind_used_.size(); ++kind)
        if (const auto& used = kind_used_[kind]; used && to_s(time - *used) <= used_lately_s)
            estimate.kinds_used |= 1u << kind;
}

} // namespace locus
