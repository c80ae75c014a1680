#include "fusion/engine.h"

#include "fusion/aid_book.h"
#include "fusion/anchor_watch.h"
#include "fusion/filter/fixed_lag.h"
#include "fusion/fresh_estimators.h"
#include "fusion/geometry/error_bound.h"
#include "fusion/gnss/receivers.h"
#include "fusion/identity.h"
#include "fusion/radio/teachers.h"
#include "fusion/target_table.h"
#include "fusion/uwb/clock_sync/synchroniser.h"
#include "fusion/vision/foot_points.h"
#include "fusion/vision/witnesses.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace locus {
namespace {

/// Stamps may lie this much after the arrival: two clocks that are read one after the other are never quite together.
constexpr Duration stamp_tolerance = duration_from_s(0.005);

SampleKey key_of(const Measurement& measurement, const Delivery& delivery) {
    return {measurement.time, measurement.input, measurement.sequence,
            static_cast<std::uint8_t>(measurement.observation.index()), delivery.sources};
}

template <std::size_t Size>
bool all_finite(const std::array<double, Size>& numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
}

/// What is made of several measurements comes into the timeline this long before it would be too late.
Duration longest_wait(const FusionSettings& fusion) {
    return duration_from_s(std::max(0.0, fusion.window_s - 2 / fusion.rate_hz));
}

/// Non-finite numbers never leave: an estimate that holds one is none.
void keep_finite(Estimate& estimate) {
    const bool finite = all_finite(estimate.position_site_m) && all_finite(estimate.velocity_site_mps) &&
                        all_finite(estimate.orientation_xyzw) && all_finite(estimate.covariance);
    if (!finite) estimate.missing = Missing::agreement;
}

PeerBelief belief(const Estimate& estimate) {
    PeerBelief belief;
    belief.position_site_m = estimate.position_site_m;
    constexpr std::array<std::size_t, 6> upper{0, 1, 2, 7, 8, 14};
    for (std::size_t i = 0; i < upper.size(); ++i)
        belief.covariance_m2[i] = static_cast<float>(estimate.covariance[upper[i]]);
    return belief;
}

void fill(Pose& pose, const Estimate& estimate) {
    pose.estimate = estimate;
    if (estimate.missing == Missing::nothing) keep_finite(pose.estimate);
    if (pose.estimate.missing == Missing::nothing) bound(pose);
}

/// What has had its effect as soon as it came; it waits for no tick.
bool is_done_with(const Observation& observation) {
    return std::holds_alternative<ClockSync>(observation) || std::holds_alternative<GnssNavigation>(observation) ||
           std::holds_alternative<GnssBaseRange>(observation);
}

} // namespace

/// For so long a target counts as seen by a camera.
constexpr Duration seen_for = std::chrono::seconds{1};

struct Engine::Impl final : uwb::ClockSynchroniser::Output, gnss::Receivers::Output, vision::FootPoints::Output {
    explicit Impl(EngineSettings given)
        : settings(std::move(given)), window(duration_from_s(settings.fusion.window_s)), fresh(settings),
          targets(settings, fresh), book(settings.site),
          clocks(settings.site, settings.clock_sync, longest_wait(settings.fusion)),
          anchors(settings.site, settings.anchor_health, static_cast<std::size_t>(settings.fusion.max_targets)),
          receivers(settings.site, settings.gnss, longest_wait(settings.fusion)),
          witnesses(targets, settings.cameras > 0),
          feet(settings.vision, settings.cameras, targets.room(), longest_wait(settings.fusion),
               duration_from_s(settings.fusion.lost_after_s)),
          teachers(targets.room()), seen(targets.room()) {
        const auto targets_at_most = static_cast<std::size_t>(settings.fusion.max_targets);
        poses.reserve(targets_at_most);
        const auto ticks = std::lround(settings.fusion.smooth_lag_s * settings.fusion.rate_hz);
        if (ticks <= 0) return;
        smoothed.reserve(targets_at_most);
        lags.reserve(targets_at_most);
        while (lags.size() < targets_at_most) lags.emplace_back(static_cast<std::size_t>(ticks));
    }

    Timestamp horizon() const noexcept { return now - window; }
    void deliver(const Measurement& measurement, Delivery delivery, Timestamp arrival) noexcept;
    Exclusion first_look(const Measurement& measurement, Timestamp arrival) const noexcept;
    Verdict hand_over(const Measurement& measurement, const Delivery& delivery, const AidBook::Record& record,
                      Timestamp arrival) noexcept;
    bool is_named_by_camera(TargetTable::Slot slot) const noexcept;
    Measurement with_peer(const Measurement& measurement, const Delivery& delivery) const noexcept;
    Exclusion hand_to_target(const Measurement& measurement, const Delivery& delivery,
                             const AidBook::Record& record) noexcept;
    void take(const Measurement& made, const AidBook::Record& record) noexcept override;
    void judge(const Measurement& measurement, const AidBook::Record& record, Exclusion reason) noexcept override;
    void tell(const Measurement& fix) noexcept override;
    std::span<const vision::LocatedTag> locate(Timestamp time) noexcept override { return witnesses.locate(time); }
    void give(const Measurement& foot, const AidBook::Record& record, const vision::FeetOwner& owner) noexcept override;
    void step_target(TargetTable::Slot slot, Timestamp tick) noexcept;
    void look_back(TargetTable::Slot slot, const Estimate& foreseen) noexcept;

    EngineSettings settings;
    Duration window;
    FreshEstimators fresh;
    TargetTable targets;
    AidBook book;
    uwb::ClockSynchroniser clocks;
    AnchorWatch anchors;
    std::vector<filter::FixedLag> lags; ///< of all slots; empty: nobody waits
    std::vector<Pose> smoothed;
    gnss::Receivers receivers;
    vision::Witnesses witnesses;
    vision::FootPoints feet;
    radio::Teachers teachers;
    struct Seen {
        SeenAs as;
        Timestamp told = timestamp_from_ns(std::numeric_limits<std::int64_t>::min() / 2);
    };
    std::vector<Seen> seen;                                                          ///< by cameras, of all slots
    std::vector<Pose> poses;                                                         ///< of the slots in use
    Timestamp now = timestamp_from_ns(std::numeric_limits<std::int64_t>::min() / 2); ///< newest arrival or tick
    Timestamp last_tick = Timestamp::min();
};

void Engine::Impl::deliver(const Measurement& measurement, Delivery delivery, Timestamp arrival) noexcept {
    const bool strangers = keep_strangers(delivery, settings.site);
    AidBook::Record record = book.hear(measurement, delivery, arrival);
    Verdict verdict{strangers ? Exclusion::unknown_source : first_look(measurement, arrival)};
    const bool waits = verdict.reason == Exclusion::none && !is_done_with(measurement.observation);
    if (verdict.reason == Exclusion::none) verdict = hand_over(measurement, delivery, record, arrival);
    if (verdict.reason != Exclusion::none || !waits) book.judge(measurement, record, verdict);
}

Exclusion Engine::Impl::first_look(const Measurement& measurement, Timestamp arrival) const noexcept {
    if (!is_finite(measurement.observation)) return Exclusion::not_finite;
    if (measurement.time > arrival + stamp_tolerance) return Exclusion::stamp_in_future;
    if (measurement.time < horizon()) return Exclusion::late;
    return Exclusion::none;
}

/// none: it waits for its tick, or it has had its effect.
Verdict Engine::Impl::hand_over(const Measurement& measurement, const Delivery& delivery, const AidBook::Record& record,
                                Timestamp arrival) noexcept {
    if (const auto* sync = std::get_if<ClockSync>(&measurement.observation))
        return delivery.sources[0] == sync->receiver ? clocks.hear(*sync, measurement.time) : Verdict{};
    if (std::holds_alternative<Arrival>(measurement.observation)) return {clocks.hear(measurement, record)};
    if (std::holds_alternative<GnssRaw>(measurement.observation))
        return {receivers.hear(measurement, record, arrival, *this)};
    if (std::holds_alternative<FootPoint>(measurement.observation))
        return {feet.hear(measurement, record, arrival, *this)};
    if (const auto* words = std::get_if<GnssNavigation>(&measurement.observation))
        return receivers.hear(*words), Verdict{};
    if (const auto* base = std::get_if<GnssBaseRange>(&measurement.observation))
        return {receivers.hear(*base, measurement.input)};
    if (const auto* fix = std::get_if<GnssFix>(&measurement.observation)) receivers.hear(*fix, measurement.time);
    return {hand_to_target(measurement, delivery, record)};
}

Exclusion Engine::Impl::hand_to_target(const Measurement& measurement, const Delivery& delivery,
                                       const AidBook::Record& record) noexcept {
    if (!delivery.tag) return Exclusion::unsupported_kind;
    const auto slot = targets.slot_of(*delivery.tag);
    if (slot == TargetTable::none) return Exclusion::unknown_target;
    const bool has_peer = std::holds_alternative<PeerRange>(measurement.observation) ||
                          std::holds_alternative<SignalStrength>(measurement.observation);
    const Measurement& told = has_peer ? with_peer(measurement, delivery) : measurement;
    const SampleKey key = key_of(measurement, delivery);
    const Exclusion reason = targets.timeline(slot).insert(told, key, record);
    if (reason != Exclusion::none) return reason;
    const auto* strength = std::get_if<SignalStrength>(&measurement.observation);
    witnesses.hear(slot, strength != nullptr ? measurement : told, key); // no name proves another's
    anchors.hear(slot, measurement);
    if (strength != nullptr) teachers.hear(slot, {delivery.sources[0], strength->rssi_dbm}, measurement.time);
    return reason;
}

/// The target's own estimator learns whose feet they are only here.
void Engine::Impl::give(const Measurement& foot, const AidBook::Record& record,
                        const vision::FeetOwner& owner) noexcept {
    const auto& point = *std::get_if<FootPoint>(&foot.observation);
    const auto slot = targets.slot_of(owner.target);
    if (slot == TargetTable::none) return judge(foot, record, Exclusion::unknown_target);
    Exclusion reason = foot.time < horizon() ? Exclusion::late : Exclusion::none;
    const Delivery delivery{owner.target, SourceKind::camera, {point.camera, no_address}, 1};
    if (reason == Exclusion::none) reason = targets.timeline(slot).insert(foot, key_of(foot, delivery), record);
    if (reason != Exclusion::none) return judge(foot, record, reason);
    teachers.see(slot, point, owner.confidence, foot.time);
    seen[slot] = {{point.camera, point.track, static_cast<float>(owner.confidence)}, now};
}

/// A range between two tags goes into the timeline with what the other one knew of itself when it came. It stays in the
/// entry, so a roll-back hears the same again; and it is of the last step, so that what one target hears in a tick does
/// not hang on which other target was run first.
Measurement Engine::Impl::with_peer(const Measurement& measurement, const Delivery& delivery) const noexcept {
    Measurement told = measurement;
    auto* range = std::get_if<PeerRange>(&told.observation);
    auto* strength = std::get_if<SignalStrength>(&told.observation);
    PeerBelief& other_knows = range != nullptr ? range->other : strength->other;
    other_knows = {};
    const auto slot = targets.find(delivery.sources[0]);
    if (slot == TargetTable::none || (strength != nullptr && !is_named_by_camera(slot))) return told;
    Estimate other = targets.timeline(slot).predict(std::max(measurement.time, last_tick));
    keep_finite(other);
    if (other.missing == Missing::nothing) other_knows = belief(other);
    return told;
}

/// A strength between two tags says little, so only of whom a camera has just seen under a name: he is known by other
/// means than by whom he hears, and nothing goes round in a circle.
bool Engine::Impl::is_named_by_camera(TargetTable::Slot slot) const noexcept {
    return now - seen[slot].told <= seen_for && seen[slot].as.confidence > 0;
}

void Engine::Impl::take(const Measurement& made, const AidBook::Record& record) noexcept {
    Exclusion reason = made.time < horizon() ? Exclusion::late : Exclusion::none;
    for (const Delivery& delivery : deliveries_of(made, settings.site))
        if (reason == Exclusion::none) reason = hand_to_target(made, delivery, record);
    if (reason != Exclusion::none) judge(made, record, reason);
}

void Engine::Impl::tell(const Measurement& fix) noexcept {
    for (const Delivery& delivery : deliveries_of(fix, settings.site)) take(fix, book.hear(fix, delivery, now));
}

void Engine::Impl::judge(const Measurement& measurement, const AidBook::Record& record, Exclusion reason) noexcept {
    AidBook::Record mine = record;
    book.judge(measurement, mine, {reason});
}

void Engine::Impl::step_target(TargetTable::Slot slot, Timestamp tick) noexcept {
    if (slot == poses.size()) poses.push_back(targets.blank_pose(slot));
    Timeline& timeline = targets.timeline(slot);
    Estimate foreseen;
    if (!lags.empty()) foreseen = timeline.predict(tick);
    timeline.run(tick, horizon(), book);
    fill(poses[slot], timeline.predict(tick));
    poses[slot].seen_as = tick - seen[slot].told <= seen_for ? seen[slot].as : SeenAs{};
    if (!lags.empty()) look_back(slot, foreseen);
}

void Engine::Impl::look_back(TargetTable::Slot slot, const Estimate& foreseen) noexcept {
    lags[slot].add(poses[slot].estimate, foreseen);
    const auto then = lags[slot].smoothed();
    if (!then) return;
    Pose& pose = smoothed.emplace_back(poses[slot]);
    fill(pose, *then);
    if (pose.estimate.missing != Missing::nothing) smoothed.pop_back();
}

Engine::Engine(EngineSettings settings) : impl_(std::make_unique<Impl>(std::move(settings))) {}
Engine::~Engine() = default;

void Engine::submit(const Measurement& measurement, Timestamp arrival) noexcept {
    impl_->now = std::max(impl_->now, arrival);
    for (const Delivery& delivery : deliveries_of(measurement, impl_->settings.site))
        impl_->deliver(measurement, delivery, arrival);
}

std::span<const Pose> Engine::step(Timestamp tick) noexcept {
    if (tick <= impl_->last_tick) return {};
    impl_->last_tick = tick;
    impl_->now = std::max(impl_->now, tick);
    impl_->book.update_rates(tick);
    impl_->clocks.run(tick, *impl_);
    impl_->smoothed.clear();
    impl_->receivers.run(tick, *impl_);
    impl_->witnesses.run(tick, impl_->horizon());
    impl_->feet.run(tick, *impl_);
    for (std::size_t slot = 0; slot < impl_->targets.size(); ++slot)
        impl_->step_target(static_cast<TargetTable::Slot>(slot), tick);
    impl_->anchors.step(tick, impl_->poses, impl_->book);
    return impl_->poses;
}

std::span<const Pose> Engine::smoothed() const noexcept { return impl_->smoothed; }
std::span<const radio::Lesson> Engine::take_lessons() noexcept { return impl_->teachers.take(); }
std::span<const AidStatus> Engine::sources() const noexcept { return impl_->book.sources(); }
const EngineCounters& Engine::counters() const noexcept { return impl_->book.total(); }
const EngineSettings& Engine::settings() const noexcept { return impl_->settings; }
std::string_view Engine::target_name(std::uint16_t index) const noexcept { return impl_->targets.name(index); }

} // namespace locus
