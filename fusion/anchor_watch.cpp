#include "fusion/anchor_watch.h"

#include "fusion/geometry/vector.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace locus {
namespace {

/// An epoch lasts until an anchor, or pair, is heard again, but at least and at most so long.
constexpr double least_epoch_s = 0.1, most_epoch_s = 0.5;
/// The pose may have been drawn aside by the very anchor that is to be found: by this many of its own sigmas, and by
/// two metres anyway.
constexpr double drawn_aside_sigma = 5, drawn_aside_m = 5;
/// By how much the error that all ranges of a tag have in common may change from one look to the next: what was
/// learnt wrongly is unlearnt in some hundred looks.
constexpr double common_walk_m2 = 0.01 * 0.01;

ReadingSettings reading_of(const uwb::AnchorHealthSettings& settings) {
    ReadingSettings reading;
    reading.range_sigma_m = settings.range_sigma_m;
    reading.range_difference_sigma_m = settings.range_difference_sigma_m;
    return reading;
}

uwb::EpochPrior prior_of(const Estimate& estimate) {
    uwb::EpochPrior prior;
    for (int axis = 0; axis < 3; ++axis) {
        const double variance_m2 = estimate.covariance[7 * static_cast<std::size_t>(axis)];
        const bool known = variance_m2 == 0; // the height of an estimator in the plane
        prior.position_sigma_m(axis) = known ? 0 : std::max(drawn_aside_m, drawn_aside_sigma * std::sqrt(variance_m2));
    }
    return prior;
}

} // namespace

AnchorWatch::AnchorWatch(const Site& site, const uwb::AnchorHealthSettings& settings, std::size_t targets)
    : site_(site), settings_(settings), reader_(site, reading_of(settings)), health_(site, settings, targets),
      gatherings_(targets) {
    waiting_.resize(most_waiting); // touches its pages now
    waiting_.clear();
    for (Gathering& gathering : gatherings_)
        gathering.common_variance_m2 = settings.common_range_error_sigma_m * settings.common_range_error_sigma_m;
}

void AnchorWatch::hear(std::uint16_t slot, const Measurement& measurement) noexcept {
    if (slot >= gatherings_.size() || waiting_.size() == waiting_.capacity()) return;
    const RangeReader::Reading reading = reader_.read(measurement);
    if (reading.reason == Exclusion::none) waiting_.push_back({slot, reading.sighting, measurement.time});
    if (reading.reason != Exclusion::reported_blocked) return;
    if (const auto* range = std::get_if<Range>(&measurement.observation))
        health_.note_blocked(reader_.index_of(range->anchor), 1);
}

void AnchorWatch::step(Timestamp tick, std::span<const Pose> poses, AidBook& book) noexcept {
    for (const Waiting& heard : waiting_)
        if (heard.slot < poses.size() && poses[heard.slot].estimate.missing == Missing::nothing)
            gather(heard, poses[heard.slot].estimate);
    waiting_.clear();
    const auto sources = book.sources();
    for (std::size_t anchor = 0; anchor < site_.anchors.size(); ++anchor)
        if (sources[anchor].counters.received > 0)
            health_.note_heard(static_cast<std::int16_t>(anchor), sources[anchor].last_time);
    if (!health_.step(tick)) return;
    for (std::size_t anchor = 0; anchor < site_.anchors.size(); ++anchor)
        book.tell_health(anchor, health_.report(anchor));
}

void AnchorWatch::gather(const Waiting& heard, const Estimate& estimate) noexcept {
    Gathering& now = gatherings_[heard.slot];
    const auto same = [&](const uwb::SightLine& line) {
        return line.sighting.plus == heard.sighting.plus && line.sighting.minus == heard.sighting.minus;
    };
    const auto find = [&] { return std::find_if(now.lines.data(), now.lines.data() + now.size, same); };
    const double age_s = to_s(heard.time - now.opened);
    const bool again = find() != now.lines.data() + now.size;
    const bool over = now.size == most_lines || age_s > most_epoch_s || (again && age_s >= least_epoch_s);
    if (now.size > 0 && over) close(heard.slot, estimate);
    if (now.size == 0) now.opened = heard.time;
    uwb::SightLine* place = find();
    if (place == now.lines.data() + now.size) ++now.size;
    *place = line_of(heard, estimate);
    now.newest = heard.time;
}

uwb::SightLine AnchorWatch::line_of(const Waiting& heard, const Estimate& estimate) const noexcept {
    const double held_m = settings_.held_error_sigma_m * (heard.sighting.is_range() ? 1 : 2);
    uwb::SightLine line{heard.sighting, vector(estimate.position_site_m)};
    line.sighting.sigma_m = static_cast<float>(std::hypot(double{heard.sighting.sigma_m}, held_m));
    line.tag_site_m -= to_s(estimate.time - heard.time) * vector(estimate.velocity_site_mps);
    return line;
}

/// Held errors make epochs alike that follow each other closely: looks are independent after twice the time in which
/// those errors change (the sum of an autoregressive process).
void AnchorWatch::close(std::uint16_t slot, const Estimate& estimate) noexcept {
    Gathering& now = gatherings_[slot];
    const double since_s = now.judged ? to_s(now.newest - *now.judged) : most_epoch_s;
    const double weight = std::clamp(since_s / (2 * settings_.held_error_time_s), 0.0, 1.0);
    uwb::AnchorHealth::Epoch epoch;
    epoch.target = slot;
    epoch.time = now.newest;
    epoch.weight = weight;
    epoch.lines = {now.lines.data(), now.size};
    epoch.prior = prior_of(estimate);
    epoch.prior.common_m = now.common_m;
    epoch.prior.common_sigma_m = std::sqrt(now.common_variance_m2);
    if (const auto common = health_.take(epoch)) learn(now, *common, weight);
    now.judged = now.newest;
    now.size = 0;
}

/// It may change slowly (temperature), and what was learnt before a bad anchor was known must be unlearnt: of what is
/// known a little is forgotten with each look.
void AnchorWatch::learn(Gathering& gathering, const uwb::AnchorHealth::Common& common, double weight) const noexcept {
    const double most_m2 = settings_.common_range_error_sigma_m * settings_.common_range_error_sigma_m;
    if (most_m2 == 0) return;
    const double before = 1 / gathering.common_variance_m2;
    const double after = before + weight * (1 / common.variance_m2 - before);
    gathering.common_m += weight * (common.error_m - gathering.common_m);
    gathering.common_variance_m2 = std::min(most_m2, 1 / after + weight * common_walk_m2);
}

} // namespace locus
