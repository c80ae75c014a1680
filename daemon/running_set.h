// What runs of a list in the settings, each with its thread and its ring: inputs and cameras. A reload keeps open what
// did not change.
#pragma once

#include "config/load.h"
#include "daemon/fusion_plan.h"
#include "drivers/recording/log_file.h"

#include <algorithm>
#include <memory>
#include <ranges>
#include <string>
#include <vector>

namespace locus {

/// Every value as text, also the defaults.
std::string fingerprint_of(const InputSettings& input);
std::string fingerprint_of(const CameraInputSettings& camera);

/// `Running` is made of settings, their place in the list and a recording, runs until it is destroyed, and has
/// request_stop(), schedule(priority), ring() and status(), of which the last two may outlive it.
template <class Settings, class Running>
class RunningSet {
  public:
    struct Slot {
        Settings settings;
        std::string fingerprint;          ///< equal: it need not be opened again
        std::unique_ptr<Running> running; ///< null: disabled
    };

    /// `recording` outlives this; null: nothing is recorded.
    explicit RunningSet(LogFile* recording = nullptr) : recording_{recording} {}
    ~RunningSet() { stop(); }
    RunningSet(const RunningSet&) = delete;
    RunningSet& operator=(const RunningSet&) = delete;

    /// Stops what is no longer wanted, then starts what is new; all run at `priority`. Blocks for about 0.1 s when
    /// something must stop.
    void apply(const std::vector<Settings>& wanted, int priority) {
        std::vector<Slot> slots = keep_unchanged(wanted);
        stop(); // before the new ones start: they may want the same device
        for (std::size_t i = 0; i < slots.size(); ++i)
            if (!slots[i].running && slots[i].settings.enabled)
                slots[i].running = std::make_unique<Running>(slots[i].settings, i, recording_);
        for (const Slot& slot : slots)
            if (slot.running) slot.running->schedule(priority);
        slots_ = std::move(slots);
    }

    /// All at once: about 0.1 s however many there are.
    void stop() {
        for (const Slot& slot : slots_)
            if (slot.running) slot.running->request_stop();
        slots_.clear();
    }

    /// Their rings; `first_index` is the index of the first in the list.
    void plan(std::vector<PlannedInput>& inputs, std::size_t first_index) const {
        for (std::size_t i = 0; i < slots_.size(); ++i)
            if (slots_[i].running)
                inputs.push_back({slots_[i].running->ring(), static_cast<std::uint16_t>(first_index + i)});
    }

    /// Every device was tried once: opened, or found missing.
    bool all_tried() const { return count(InputState::starting) == 0; }
    std::size_t open() const { return count(InputState::open); }
    std::size_t size() const { return slots_.size(); }
    const std::vector<Slot>& slots() const { return slots_; }

  private:
    /// Takes over those whose settings and place are the same; their slots before are left empty.
    std::vector<Slot> keep_unchanged(const std::vector<Settings>& wanted) {
        std::vector<Slot> slots;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            Slot slot{wanted[i], fingerprint_of(wanted[i]), nullptr};
            const auto same = std::ranges::find_if(slots_, [&](const Slot& before) {
                return before.fingerprint == slot.fingerprint && Running::may_move_to(i, place_of(before));
            });
            if (same != slots_.end()) slot.running = std::move(same->running);
            slots.push_back(std::move(slot));
        }
        return slots;
    }
    std::size_t place_of(const Slot& slot) const { return static_cast<std::size_t>(&slot - slots_.data()); }

    std::size_t count(InputState state) const {
        return static_cast<std::size_t>(std::ranges::count_if(
            slots_, [&](const Slot& slot) { return slot.running && slot.running->status()->state == state; }));
    }

    LogFile* recording_;
    std::vector<Slot> slots_; ///< in the order of the settings
};

} // namespace locus
