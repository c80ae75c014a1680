// The publisher's picture of the world: the newest pose of every target, the newest status of every source, the ticks
// of the last ten seconds. Pure: fed from the rings, asked by the answers.
#pragma once

#include "daemon/output.h"

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <vector>

namespace locus {

struct TargetView {
    Pose pose;
    Timestamp previous{};            ///< time of the pose that went out before this one
    std::uint32_t resets_before = 0; ///< of earlier engines: what clients see never goes back
    std::uint32_t reset_count() const { return resets_before + pose.estimate.reset_count; }
};

struct TickLateness {
    double p50_us = 0;
    double p99_us = 0;
    double max_us = 0;
};

class Picture {
  public:
    /// The view after the pose went in.
    const TargetView& take(const PoseItem& item);

    void take(const SourceItem& item);
    void take(const TickItem& item);

    const std::map<Address, TargetView>& targets() const { return targets_; }
    const std::vector<AidStatus>& sources() const { return sources_; }
    const TickItem& tick() const { return tick_; }

    /// Over the last ten seconds; empty before the first tick.
    std::optional<TickLateness> lateness() const;

  private:
    void follow(Generation generation);

    Generation generation_ = 0;
    std::map<Address, TargetView> targets_;
    std::map<Address, std::uint32_t> resets_before_;
    std::vector<AidStatus> sources_;
    TickItem tick_;
    std::deque<TickItem> recent_;
};

/// Whether a client that wants `rate_hz` poses a second gets this one: the first of each interval of 1 / rate_hz.
/// `previous` is the time of the pose before it of the same target; rate 0: every one.
bool is_due(Timestamp previous, Timestamp time, double rate_hz);

} // namespace locus
