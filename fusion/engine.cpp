#include "fusion/engine.h"

#include "fusion/aid_book.h"
#include "fusion/fresh_estimators.h"
#include "fusion/geometry/error_bound.h"
#include "fusion/identity.h"
#include "fusion/target_table.h"

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

/// Non-finite numbers never leave: an estimate that holds one is none.
void keep_finite(Estimate& estimate) {
    const bool finite = all_finite(estimate.position_site_m) && all_finite(estimate.velocity_site_mps) &&
                        all_finite(estimate.orientation_xyzw) && all_finite(estimate.covariance);
    if (!finite) estimate.missing = Missing::agreement;
}

void fill(Pose& pose, const Estimate& estimate) {
    pose.estimate = estimate;
    if (estimate.missing == Missing::nothing) keep_finite(pose.estimate);
    if (pose.estimate.missing != Missing::nothing) return;
    const auto& p = estimate.covariance;
    pose.horizontal_error_95_m = horizontal_error_95_m(p[0], p[1], p[7]);
    pose.vertical_error_95_m = vertical_error_95_m(p[14]);
}

} // namespace

struct Engine::Impl {
    explicit Impl(EngineSettings given)
        : settings(std::move(given)), window(duration_from_s(settings.fusion.window_s)), fresh(settings),
          targets(settings, fresh), book(settings.site) {
        poses.reserve(static_cast<std::size_t>(settings.fusion.max_targets));
    }

    Timestamp horizon() const noexcept { return now - window; }
    void deliver(const Measurement& measurement, Delivery delivery, Timestamp arrival) noexcept;
    Exclusion first_look(const Measurement& measurement, Timestamp arrival) const noexcept;
    Exclusion hand_over(const Measurement& measurement, const Delivery& delivery,
                        const AidBook::Record& record) noexcept;
    void step_target(TargetTable::Slot slot, Timestamp tick) noexcept;

    EngineSettings settings;
    Duration window;
    FreshEstimators fresh;
    TargetTable targets;
    AidBook book;
    std::vector<Pose> poses;                                                         ///< of the slots in use
    Timestamp now = timestamp_from_ns(std::numeric_limits<std::int64_t>::min() / 2); ///< newest arrival or tick
    Timestamp last_tick = Timestamp::min();
};

void Engine::Impl::deliver(const Measurement& measurement, Delivery delivery, Timestamp arrival) noexcept {
    const bool strangers = keep_strangers(delivery, settings.site);
    AidBook::Record record = book.hear(measurement, delivery, arrival);
    Exclusion reason = strangers ? Exclusion::unknown_source : first_look(measurement, arrival);
    if (reason == Exclusion::none) reason = hand_over(measurement, delivery, record);
    if (reason != Exclusion::none) book.judge(measurement, record, {reason});
}

Exclusion Engine::Impl::first_look(const Measurement& measurement, Timestamp arrival) const noexcept {
    if (!is_finite(measurement.observation)) return Exclusion::not_finite;
    if (measurement.time > arrival + stamp_tolerance) return Exclusion::stamp_in_future;
    if (measurement.time < horizon()) return Exclusion::late;
    return Exclusion::none;
}

Exclusion Engine::Impl::hand_over(const Measurement& measurement, const Delivery& delivery,
                                  const AidBook::Record& record) noexcept {
    if (!delivery.tag) return Exclusion::unsupported_kind;
    const auto slot = targets.slot_of(*delivery.tag);
    if (slot == TargetTable::none) return Exclusion::unknown_target;
    return targets.timeline(slot).insert(measurement, key_of(measurement, delivery), record);
}

void Engine::Impl::step_target(TargetTable::Slot slot, Timestamp tick) noexcept {
    if (slot == poses.size()) poses.push_back(targets.blank_pose(slot));
    Timeline& timeline = targets.timeline(slot);
    timeline.run(tick, horizon(), book);
    fill(poses[slot], timeline.predict(tick));
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
    for (std::size_t slot = 0; slot < impl_->targets.size(); ++slot)
        impl_->step_target(static_cast<TargetTable::Slot>(slot), tick);
    return impl_->poses;
}

std::span<const AidStatus> Engine::sources() const noexcept { return impl_->book.sources(); }
const EngineCounters& Engine::counters() const noexcept { return impl_->book.total(); }
const EngineSettings& Engine::settings() const noexcept { return impl_->settings; }
std::string_view Engine::target_name(std::uint16_t index) const noexcept { return impl_->targets.name(index); }

} // namespace locus
