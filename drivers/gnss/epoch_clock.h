// The time of a receiver's epochs, brought to the host's clock: what it measured at one moment comes some ten or
// hundred milliseconds later, and never after the same time. The time of week (UBX) or of day (NMEA) that stands in its
// messages is the counter of a device like any other (drivers/device_clock.h), once it no longer begins anew: weeks,
// dates and leap seconds then do not matter.
#pragma once

#include "drivers/device_clock.h"

#include <cstdint>
#include <optional>

namespace locus::gnss {

class EpochClock {
  public:
    static constexpr std::int64_t week_ns = 604'800'000'000'000, day_ns = 86'400'000'000'000;
    /// So much back is no jump: one epoch's messages may tell it by the receiver's own clock and by GPS time, and what
    /// waits for another receiver (the heading of two) comes when the next epoch's fix has overtaken it. Receivers that
    /// set their time do it by whole seconds, or by a millisecond.
    static constexpr std::int64_t overtaken_ns = 250'000'000;

    /// `period_ns`: after so much the told time begins anew.
    explicit EpochClock(std::int64_t period_ns) : period_ns_{period_ns} {}

    /// When it was `told_ns` (since the period began) for the receiver, by a message that began to come at `received`.
    /// A receiver that sets its time makes the estimate begin anew, as DeviceClock does with a counter that jumps.
    Timestamp host_time(std::int64_t told_ns, Timestamp received);

    /// Forgets all: the receiver was opened again.
    void reset();

  private:
    /// Epochs come once a second or ten times, and late by what the receiver computes, which grows with its load: some
    /// 0.1 s. Those who set their time do it by seconds: a step of one (a leap second that was not told) is a restart.
    /// GPS time does not drift, only the host's crystal does.
    static constexpr DeviceClock::Limits limits{
        .largest_drift = 100e-6, .restart_s = 0.8, .jump_s = 0.25, .patience = std::chrono::seconds{5}};

    std::int64_t period_ns_;
    DeviceClock clock_{1e-9, 64, limits};
    bool begun_ = false;
    std::int64_t told_ns_ = 0;
    std::uint64_t count_ns_ = 0; ///< the same, never beginning anew
    Timestamp said_{};

    std::int64_t since_last_ns(std::int64_t told_ns) const;
};

} // namespace locus::gnss
