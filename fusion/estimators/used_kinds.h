// Which kinds of measurement went into a state lately: what Estimate::kinds_used says.
#pragma once

#include "fusion/measurement.h"

#include <array>
#include <cstdint>

namespace locus {

class UsedKinds {
  public:
    void note(const Observation& observation, Timestamp time) noexcept { last_[observation.index()] = time; }

    /// Bit i: alternative i of Observation was used within the second before `time`.
    std::uint32_t lately(Timestamp time) const noexcept {
        std::uint32_t bits = 0;
        for (std::size_t kind = 0; kind < last_.size(); ++kind)
            if (last_[kind] != never && to_s(time - last_[kind]) <= memory_s) bits |= 1u << kind;
        return bits;
    }

  private:
    static constexpr double memory_s = 1;
    static constexpr Timestamp never = Timestamp::min();

    std::array<Timestamp, std::variant_size_v<Observation>> last_ = [] {
        std::array<Timestamp, std::variant_size_v<Observation>> last{};
        last.fill(never);
        return last;
    }();
};

} // namespace locus
