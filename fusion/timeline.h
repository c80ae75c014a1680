// Timeline: one target's measurements in the order of their sample times, whatever the order in which they came. A
// measurement older than what was already used rolls the estimator back to a snapshot and runs it forward again, so the
// state is the same, to the bit, as if all had come in order. All memory is set aside at construction.
#pragma once

#include "fusion/aid_book.h"
#include "fusion/estimators/estimator.h"

#include <boost/circular_buffer.hpp>

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <vector>

namespace locus {

/// A total order over the samples of one target that does not depend on when they came.
struct SampleKey {
    static constexpr Timestamp never = Timestamp::min();

    Timestamp time = never;
    std::uint16_t input = 0;
    std::uint32_t sequence = 0;
    std::uint8_t kind = 0; ///< alternative of Observation
    std::array<Address, 2> sources{};

    friend auto operator<=>(const SampleKey&, const SampleKey&) = default;
};

struct TimelineLimits {
    std::size_t measurements = 0;
    std::size_t snapshots = 0;
    Duration snapshot_spacing{};
    Duration lost_after{}; ///< without a used measurement for this long the estimator starts anew
};

class Timeline {
  public:
    /// `fresh` is an estimator in its first state; it outlives the timeline.
    Timeline(const Estimator& fresh, const TimelineLimits& limits);

    /// Another one as this was at first.
    Timeline blank() const { return {fresh_, limits_}; }

    /// Keeps a measurement until its tick. Exclusion::none: kept; else duplicate or window_full, and nothing changed.
    /// It must not be older than the `horizon` of the last run().
    Exclusion insert(const Measurement& measurement, const SampleKey& key, const AidBook::Record& record) noexcept;

    /// Brings the state to what all measurements up to `tick` make of it, then forgets what lies before `horizon`.
    void run(Timestamp tick, Timestamp horizon, AidBook& book) noexcept;

    /// The state at `tick`, which must not lie before the last run().
    Estimate predict(Timestamp tick) const noexcept;

  private:
    struct Entry {
        SampleKey key;
        Measurement measurement;
        AidBook::Record record;
    };

    /// All that a measurement can change; this is what a snapshot holds.
    struct State {
        explicit State(const Estimator& fresh) : estimator(fresh.clone()) {}
        void copy_from(const State& other) noexcept;

        std::unique_ptr<Estimator> estimator;
        SampleKey last; ///< newest measurement in it
        Timestamp last_used = SampleKey::never;
        std::uint32_t resets = 0; ///< of estimators that were started anew, theirs and the new starts
    };

    bool is_lost(Timestamp time) const noexcept;
    void rewind() noexcept;
    void apply(Entry& entry, AidBook& book) noexcept;
    void start_anew() noexcept;
    void take_snapshot_before(const Entry& entry) noexcept;
    void forget(Timestamp horizon) noexcept;

    State& snapshot(std::size_t i) noexcept { return snapshots_[(first_snapshot_ + i) % snapshots_.size()]; }
    State& newest_snapshot() noexcept { return snapshot(snapshot_count_ - 1); }
    void drop_oldest_snapshot() noexcept;

    static constexpr std::size_t clean = static_cast<std::size_t>(-1);

    const Estimator& fresh_;
    TimelineLimits limits_;
    boost::circular_buffer<Entry> entries_; ///< by key
    std::size_t next_ = 0;                  ///< first entry that is not in head_
    std::size_t dirty_ = clean;             ///< first entry that should be in head_ and is not
    State head_;
    std::vector<State> snapshots_; ///< ring, oldest first; there is always one, and it lies before the horizon
    std::size_t first_snapshot_ = 0;
    std::size_t snapshot_count_ = 1;
};

} // namespace locus
