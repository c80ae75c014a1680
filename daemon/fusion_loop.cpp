#include "daemon/fusion_loop.h"

#include "daemon/realtime.h"
#include "drivers/clock.h"
#include "fusion/identity.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace locus {
namespace {

/// The longest sleep without looking whether to stop, and without a sign of life.
constexpr Duration longest_sleep = std::chrono::milliseconds{100};

/// Every source's status goes out about this often, spread evenly over the ticks.
constexpr Duration status_interval = std::chrono::milliseconds{200};

} // namespace

FusionLoop::FusionLoop(std::unique_ptr<FusionPlan> first, FusionOutput& output, const Wake& ticked)
    : plan_{std::move(first)}, output_{output}, ticked_{ticked}, schedule_{period_of(plan_->rate_hz)} {}

void FusionLoop::run(const std::stop_token& stop) {
    touch_stack();
    apply_scheduling();
    for (;;) {
        const Timestamp tick = schedule_.next(monotonic_now());
        if (!wait_until(tick, stop)) return;
        adopt_plan();
        cycle(tick);
    }
}

/// False: asked to stop.
bool FusionLoop::wait_until(Timestamp tick, const std::stop_token& stop) {
    const Timestamp wake = tick - plan_->spin;
    do {
        const bool stalled = stalled_.load(std::memory_order_relaxed);
        if (!stalled) heartbeat_.fetch_add(1, std::memory_order_relaxed);
        sleep_until(stalled ? monotonic_now() + longest_sleep : std::min(wake, monotonic_now() + longest_sleep));
        if (stop.stop_requested()) return false;
    } while (monotonic_now() < wake || stalled_.load(std::memory_order_relaxed));
    while (monotonic_now() < tick) {
    }
    return true;
}

void FusionLoop::cycle(Timestamp tick) noexcept {
    const Duration late = monotonic_now() - tick;
    ++ticks_;
    overruns_ += late > schedule_.period();
    adopt_grid();
    drain_inputs();
    publish_poses(tick);
    publish_sources();
    publish_lessons();
    publish_tick(tick, late);
    ticked_.raise();
}

void FusionLoop::drain_inputs() noexcept {
    for (const PlannedInput& input : plan_->inputs)
        // At most one ringful, so that no input, however fast, keeps the others or the tick waiting.
        for (std::size_t n = 0; n < MeasurementRing::capacity(); ++n) {
            Measurement measurement;
            if (!input.ring->pop(measurement)) break;
            measurement.input = input.index;
            plan_->engine->submit(measurement, monotonic_now()); // read after the pop: never before the stamp
            publish_reading(measurement);
        }
}

void FusionLoop::publish_reading(const Measurement& measurement) noexcept {
    const auto* strength = std::get_if<SignalStrength>(&measurement.observation);
    if (strength == nullptr || !std::isfinite(strength->rssi_dbm)) return;
    for (const Delivery& delivery : deliveries_of(measurement, plan_->engine->settings().site)) {
        const Address tag = delivery.tag.value_or(no_address);
        output_.readings.push({measurement.time, tag, delivery.sources[0], strength->rssi_dbm});
    }
}

void FusionLoop::publish_poses(Timestamp tick) noexcept {
    const auto poses = plan_->engine->step(tick);
    PoseItem item;
    item.generation = plan_->generation;
    const Timestamp published = monotonic_now();
    std::uint32_t positions = 0;
    for (const Pose& pose : poses) {
        positions += pose.estimate.missing == Missing::nothing;
        item.pose = pose;
        item.pose.published = published;
        output_.poses.push(item);
    }
    item.smoothed = true;
    for (const Pose& pose : plan_->engine->smoothed()) {
        item.pose = pose;
        item.pose.published = published;
        output_.poses.push(item);
    }
    positions_.store(positions, std::memory_order_relaxed);
}

void FusionLoop::publish_sources() noexcept {
    const auto sources = plan_->engine->sources();
    const double share = static_cast<double>(schedule_.period().count()) / static_cast<double>(status_interval.count());
    const bool all = std::exchange(show_all_sources_, false);
    const auto budget =
        static_cast<std::size_t>(std::ceil((all ? 1.0 : std::min(1.0, share)) * static_cast<double>(sources.size())));
    const auto count = static_cast<std::uint16_t>(sources.size());
    for (std::size_t sent = 0; sent < budget; ++sent) {
        next_source_ = next_source_ + 1 < sources.size() ? next_source_ + 1 : 0;
        output_.sources.push(
            {plan_->generation, static_cast<std::uint16_t>(next_source_), count, sources[next_source_]});
    }
}

void FusionLoop::publish_lessons() noexcept {
    for (const radio::Lesson& lesson : plan_->engine->take_lessons()) output_.lessons.push(lesson);
}

void FusionLoop::publish_tick(Timestamp tick, Duration late) noexcept {
    TickItem item;
    item.generation = plan_->generation;
    item.tick = tick;
    item.late = late;
    item.ticks = ticks_;
    item.overruns = overruns_;
    item.poses_dropped = output_.poses.dropped();
    item.realtime = scheduling() == Scheduling::realtime;
    item.engine = plan_->engine->counters();
    output_.ticks.push(item);
}

void FusionLoop::adopt_plan() noexcept {
    auto next = plans.take();
    if (!next) return;
    if (!next->engine) next->engine.swap(plan_->engine);
    plan_.swap(next);
    schedule_.set_period(period_of(plan_->rate_hz));
    next_source_ = 0;
    show_all_sources_ = true;
    if (next->priority != plan_->priority) apply_scheduling();
    retired.give(next); // never full: the main thread has at most one plan on its way
}

void FusionLoop::adopt_grid() noexcept {
    auto next = grids.take();
    if (!next) return;
    next->in_use->exchange(next->grid); // refused: what comes back is the same again
    retired_grids.give(next);           // never full: at most one is on its way
}

void FusionLoop::apply_scheduling() noexcept {
    const bool realtime = schedule_this_thread(plan_->priority);
    scheduling_.store(realtime ? Scheduling::realtime : Scheduling::ordinary, std::memory_order_relaxed);
}

} // namespace locus
