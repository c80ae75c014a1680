// The fusion thread: at each tick, rings in, engine, rings out. No lock, no allocation, no log, and no system call but
// the sleep and one eventfd write a tick: a publisher that polled would add half its polling period to every pose, the
// write costs about a microsecond, never blocks, and comes after the poses are in the ring.
#pragma once

#include "daemon/fusion_plan.h"
#include "daemon/handover.h"
#include "daemon/tick_schedule.h"
#include "daemon/wake.h"
#include "fusion/radio/grid_in_use.h"

#include <atomic>
#include <memory>
#include <stop_token>

namespace locus {

/// A grid for where another is in use; back comes what was.
struct NewGrid {
    std::shared_ptr<radio::GridInUse> in_use;
    radio::GridInUse::Shared grid;
};

class FusionLoop {
  public:
    /// `first` has an engine. `output` and `ticked` outlive this.
    FusionLoop(std::unique_ptr<FusionPlan> first, FusionOutput& output, const Wake& ticked);

    /// Ticks until asked to stop (heard within 0.1 s). Call it once, in its own thread.
    void run(const std::stop_token& stop);

    /// All that happens at one tick. run() calls it; tests call it alone.
    void cycle(Timestamp tick) noexcept;

    Handover<FusionPlan> plans;      ///< main thread -> here
    Handover<FusionPlan> retired;    ///< here -> main thread, to be freed
    Handover<NewGrid> grids;         ///< who keeps the radio map -> here
    Handover<NewGrid> retired_grids; ///< here -> who keeps the radio map

    /// Any thread. Moves at least ten times a second while run() is well.
    std::uint64_t heartbeat() const { return heartbeat_.load(std::memory_order_relaxed); }
    enum class Scheduling : std::uint8_t { unknown, ordinary, realtime };
    /// What the kernel allowed.
    Scheduling scheduling() const { return scheduling_.load(std::memory_order_relaxed); }
    /// Targets that have a position now. Any thread.
    std::uint32_t positions() const { return positions_.load(std::memory_order_relaxed); }
    /// Debug hook of the rig: the thread stays alive but does no more work.
    void stall() { stalled_.store(true, std::memory_order_relaxed); }

  private:
    bool wait_until(Timestamp tick, const std::stop_token& stop);
    void adopt_plan() noexcept;
    void adopt_grid() noexcept;
    void apply_scheduling() noexcept;
    void drain_inputs() noexcept;
    void publish_reading(const Measurement& measurement) noexcept;
    void publish_poses(Timestamp tick) noexcept;
    void publish_sources() noexcept;
    void publish_lessons() noexcept;
    void publish_tick(Timestamp tick, Duration late) noexcept;

    std::unique_ptr<FusionPlan> plan_;
    FusionOutput& output_;
    const Wake& ticked_;
    TickSchedule schedule_;
    std::size_t next_source_ = 0;
    bool show_all_sources_ = true; ///< at the first tick of a plan
    std::uint64_t ticks_ = 0;
    std::uint64_t overruns_ = 0;
    std::atomic<std::uint32_t> positions_{0};
    std::atomic<std::uint64_t> heartbeat_{0};
    std::atomic<Scheduling> scheduling_{Scheduling::unknown};
    std::atomic<bool> stalled_{false};
};

} // namespace locus
