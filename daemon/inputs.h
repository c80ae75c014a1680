// The inputs of the configuration in force, each with its thread and its ring. A reload keeps open what did not change.
#pragma once

#include "config/settings.h"
#include "daemon/fusion_plan.h"
#include "daemon/rate_limit.h"
#include "daemon/realtime.h"
#include "daemon/socket/roster.h"
#include "drivers/input.h"
#include "drivers/recording/log_file.h"

#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace locus {

/// One input at work. Destroyed, it has stopped.
class RunningInput {
  public:
    /// `recording` gets every packet; null: none is kept.
    RunningInput(const InputSettings& settings, LogFile* recording);

    void request_stop() { thread_.request_stop(); }
    /// SCHED_FIFO where allowed; 0: ordinary.
    void schedule(int priority) { schedule_thread(thread_.native_handle(), priority); }
    /// Both may outlive this.
    std::shared_ptr<MeasurementRing> ring() const { return {body_, &body_->ring}; }
    std::shared_ptr<const InputStatus> status() const { return {body_, &body_->input.status()}; }

  private:
    struct Body {
        Body(InputSettings given, LogFile* recording);
        InputParts parts();
        void log(const InputEvent& event);

        InputSettings settings;
        RateLimit lines{20, std::chrono::seconds{5}}; ///< a loose plug comes and goes ten times a second
        std::optional<LogTap> tap;
        MeasurementRing ring;
        Input input;
    };
    std::shared_ptr<Body> body_;
    std::jthread thread_;
};

class InputSet {
  public:
    /// `recording` outlives this; null: nothing is recorded.
    explicit InputSet(LogFile* recording = nullptr) : recording_{recording} {}
    ~InputSet() { stop(); }
    InputSet(const InputSet&) = delete;
    InputSet& operator=(const InputSet&) = delete;

    /// Stops what is no longer wanted, then starts what is new; all run at `priority`. Blocks for about 0.1 s when
    /// something must stop.
    void apply(const std::vector<InputSettings>& wanted, int priority);

    /// All at once: about 0.1 s however many there are.
    void stop();

    std::vector<PlannedInput> planned() const;
    std::vector<InputEntry> entries() const;

    /// Every device was tried once: opened, or found missing.
    bool all_tried() const;
    std::size_t open() const;
    std::size_t size() const { return slots_.size(); }

  private:
    struct Slot {
        InputSettings settings;
        std::string fingerprint;               ///< equal: the input need not be opened again
        std::unique_ptr<RunningInput> running; ///< null: disabled
    };
    static std::vector<Slot> keep_unchanged(std::vector<Slot>& before, const std::vector<InputSettings>& wanted);
    static void stop(std::vector<Slot>& slots);

    LogFile* recording_;
    std::vector<Slot> slots_; ///< in the order of the settings
};

} // namespace locus
