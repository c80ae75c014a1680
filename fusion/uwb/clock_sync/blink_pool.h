// Blinks that wait: one slot for each, with the arrivals at the anchors that heard it, which come one by one from
// several inputs. All memory is set aside at construction.
#pragma once

#include "fusion/aid_book.h"
#include "fusion/measurement.h"
#include "fusion/uwb/clock_sync/clock_graph.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace locus::uwb {

struct HeardBlink {
    ClockGraph::Node anchor = ClockGraph::nobody;
    Measurement arrival;
    AidBook::Record record;
    std::optional<ClockGraph::RootTime> time{}; ///< in the root's clock, where that is known
};

/// A blink, by its tag and its number. Numbers come again (after 256 blinks with most tags), so the time counts as
/// well.
struct Blink {
    static constexpr std::size_t most_heard = 16;

    Address tag = no_address;
    std::uint32_t sequence = 0;
    Timestamp time{}; ///< the earliest arrival's: it was the least delayed on its way to the host
    std::array<HeardBlink, most_heard> heard{};
    std::size_t count = 0;

    std::span<HeardBlink> arrivals() noexcept { return {heard.data(), count}; }
    std::span<const HeardBlink> arrivals() const noexcept { return {heard.data(), count}; }
    bool was_heard_by(ClockGraph::Node anchor) const noexcept;
    void drop(const HeardBlink& one) noexcept;
};

class BlinkPool {
  public:
    static constexpr std::size_t room = 256;

    /// Arrivals further apart than `gather` are not of one blink.
    explicit BlinkPool(Duration gather, bool wanted = true) : gather_(gather), blinks_(wanted ? room : 0) {
        for (auto& blink : blinks_) free_.push_back(&blink);
        waiting_.reserve(blinks_.size());
    }

    /// none: kept. The measurement holds an Arrival.
    Exclusion keep(const Measurement& arrival, ClockGraph::Node anchor, const AidBook::Record& record) noexcept;

    /// Calls `deal(blink)` for each blink in the order in which they came, and forgets those of which it says true.
    template <class Deal>
    void deal(const Deal& deal) noexcept {
        std::erase_if(waiting_, [&](Blink* blink) {
            if (!deal(*blink)) return false;
            free_.push_back(blink);
            return true;
        });
    }

  private:
    Blink* waiting_blink(const Arrival& arrival, Timestamp time) noexcept;
    Blink* open_blink(const Arrival& arrival, Timestamp time) noexcept;

    Duration gather_;
    std::vector<Blink> blinks_;
    std::vector<Blink*> free_;
    std::vector<Blink*> waiting_; ///< as they came
};

} // namespace locus::uwb
