// One input at work, with its thread and its ring.
#pragma once

#include "daemon/event_log.h"
#include "daemon/realtime.h"
#include "daemon/running_set.h"
#include "daemon/socket/roster.h"
#include "drivers/input.h"

#include <memory>
#include <optional>
#include <thread>
#include <vector>

namespace locus {

/// Destroyed, it has stopped.
class RunningInput {
  public:
    /// `recording` gets every packet; null: none is kept.
    RunningInput(const InputSettings& settings, std::size_t place, LogFile* recording);

    void request_stop() { thread_.request_stop(); }
    /// SCHED_FIFO where allowed; 0: ordinary.
    void schedule(int priority) { schedule_thread(thread_.native_handle(), priority); }
    /// Both may outlive this.
    std::shared_ptr<MeasurementRing> ring() const { return {body_, &body_->ring}; }
    std::shared_ptr<const InputStatus> status() const { return {body_, &body_->input.status()}; }

    /// Measurements get their input's index from the plan.
    static bool may_move_to(std::size_t /*place*/, std::size_t /*before*/) { return true; }

  private:
    struct Body {
        Body(InputSettings given, LogFile* recording);
        InputParts parts();

        InputSettings settings;
        EventLog log;
        std::optional<LogTap> tap;
        MeasurementRing ring;
        Input input;
    };
    std::shared_ptr<Body> body_;
    std::jthread thread_;
};

using InputSet = RunningSet<InputSettings, RunningInput>;

std::vector<InputEntry> entries(const InputSet& inputs);

} // namespace locus
