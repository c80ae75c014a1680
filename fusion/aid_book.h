// The book of all sources: who was heard, what became of it and why. One AidStatus for each anchor of the site from the
// start, and room set aside for strangers and other kinds of source; beyond that a source is counted only in the total.
#pragma once

#include "fusion/aid_status.h"
#include "fusion/flat_index.h"
#include "fusion/identity.h"
#include "fusion/site.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace locus {

class AidBook {
  public:
    /// Sources besides the site's anchors that get a status of their own.
    static constexpr std::size_t room_for_others = 128;

    /// What the book must know of a measurement to judge it now, and to judge it anew after a roll-back.
    struct Record {
        std::array<std::uint16_t, 2> sources{no_source, no_source};
        Exclusion counted = Exclusion::count_; ///< the verdict in the counters; count_: none yet
    };

    explicit AidBook(const Site& site);

    /// Counts a measurement as heard.
    Record hear(const Measurement& measurement, const Delivery& delivery, Timestamp arrival) noexcept;

    /// Writes down what became of a measurement; a verdict given earlier is taken back first.
    void judge(const Measurement& measurement, Record& record, const Verdict& verdict) noexcept;

    void count_roll_back() noexcept { ++total_.rolled_back; }

    /// To be called each tick: brings the rates up to date about once a second, also of those that fell silent.
    void update_rates(Timestamp tick) noexcept;

    /// Anchors of the site hold the first places, in its order.
    void tell_health(std::size_t anchor, const AnchorReport& report) noexcept { sources_[anchor].health = report; }

    std::span<const AidStatus> sources() const noexcept { return sources_; }
    const EngineCounters& total() const noexcept { return total_; }

  private:
    using Key = std::pair<SourceKind, Address>;
    static constexpr std::uint16_t no_source = FlatIndex<Key>::none;

    std::uint16_t source_index(Key key) noexcept;
    void open(Key key) noexcept;
    void count(const Record& record, std::uint64_t step) noexcept;

    FlatIndex<Key> index_;
    std::vector<AidStatus> sources_;
    std::vector<std::uint32_t> heard_in_block_; ///< beside sources_
    std::optional<Timestamp> block_start_;
    EngineCounters total_;
};

} // namespace locus
