// Wireless clock synchronisation: sync packets between anchors and a tag's blinks at anchors come in, each in a clock
// of its own; range differences go out.
//
// A sync packet goes into its link at once: one receiver's packets come by one input, so they are in order. A blink
// waits gather_s for the other anchors, and up to wait_s for the sync packet after it. What it becomes is worked out
// from its arrivals, the last sync packet of each link before it and the first one after it, by their stamps: which
// input was read first does not go in, as long as nothing is later than wait_s. Differences carry the time of the
// blink; the timeline of the tag puts them there.
#pragma once

#include "fusion/uwb/clock_sync/blink_pool.h"
#include "fusion/uwb/clock_sync/clock_graph.h"

namespace locus::uwb {

class ClockSynchroniser {
  public:
    /// What becomes of the arrivals. The record is the arrival's: an arrival and the difference made of it count as
    /// one.
    class Output {
      public:
        virtual ~Output() = default;
        /// A range difference, to be judged by whoever takes it.
        virtual void take(const Measurement& difference, const AidBook::Record& record) noexcept = 0;
        /// The last word on an arrival: none if it is the one that the others of its blink are compared with.
        virtual void judge(const Measurement& measurement, const AidBook::Record& record,
                           Exclusion reason) noexcept = 0;
    };

    /// `site` outlives it. A blink never waits longer than `longest_wait`.
    ClockSynchroniser(const Site& site, const ClockSyncSettings& settings, Duration longest_wait);

    Verdict hear(const ClockSync& packet, Timestamp time) noexcept;

    /// none: kept, and Output will hear of it.
    Exclusion hear(const Measurement& arrival, const AidBook::Record& record) noexcept;

    /// Deals with every blink whose time has come.
    void run(Timestamp tick, Output& output) noexcept;

  private:
    bool deal(Blink& blink, Timestamp tick, Output& output) noexcept;
    void place(Blink& blink) const noexcept;
    void compare(Blink& blink, Output& output) const noexcept;
    bool fits_nobody(Blink& blink, const HeardBlink& reference) const noexcept;
    bool give(const Blink& blink, const HeardBlink* reference, const HeardBlink& heard, Output& output) const noexcept;
    std::optional<RangeDifference> difference(const HeardBlink& a, const HeardBlink& b) const noexcept;
    bool is_possible(const RangeDifference& difference) const noexcept;

    const Site& site_;
    Duration gather_;
    Duration wait_;
    WrappingClock clock_;
    double arrival_variance_ticks2_;
    double max_clock_variance_ticks2_;
    ClockGraph graph_;
    BlinkPool blinks_;
};

} // namespace locus::uwb
