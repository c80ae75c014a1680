// The gates of all anchors, and what they say together. One anchor refused is its own fault; most of them refused, and
// that for a while, is the filter's: it is in the wrong place. Each anchor has one voice, its newest, however often it
// speaks and in whatever order a sweep brings them.
#pragma once

#include "fusion/filter/gate.h"
#include "fusion/time.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace locus::filter {

class AnchorGates {
  public:
    explicit AnchorGates(std::size_t anchors) : voices_(anchors) {}

    /// Of the anchor with this index, which speaks at `time`.
    Gate& gate(std::int16_t anchor, Timestamp time) noexcept {
        Voice& voice = voices_[static_cast<std::size_t>(anchor)];
        voice.heard = time;
        return voice.gate;
    }

    /// To be asked after each measurement: whether most anchors heard lately have been in doubt for a while. All of
    /// them must have been for `patience_s`, some of them for longer.
    bool most_in_doubt(Timestamp time, double patience_s) noexcept {
        const double since_s = asked_ == never ? 0 : to_s(time - asked_);
        const double fresh = -std::expm1(-std::numbers::ln2 * since_s / patience_s);
        asked_ = time;
        doubt_ += fresh * (share_in_doubt(time) - doubt_);
        return doubt_ >= 0.5;
    }

    /// The filter is somewhere else now.
    void begin_anew() noexcept { doubt_ = 0; }

  private:
    static constexpr Timestamp never = Timestamp::min();
    static constexpr double lately_s = 1;

    struct Voice {
        Gate gate;
        Timestamp heard = never;
    };

    double share_in_doubt(Timestamp time) const noexcept {
        const auto lately = [time](const Voice& v) { return v.heard != never && to_s(time - v.heard) <= lately_s; };
        const auto heard = std::ranges::count_if(voices_, lately);
        const auto doubted =
            std::ranges::count_if(voices_, [&](const Voice& v) { return lately(v) && v.gate.is_in_doubt(); });
        return heard == 0 ? 0 : static_cast<double>(doubted) / static_cast<double>(heard);
    }

    std::vector<Voice> voices_;
    Timestamp asked_ = never;
    double doubt_ = 0;
};

} // namespace locus::filter
