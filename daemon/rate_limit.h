// How many lines of one kind the log gets: a burst, then one each `interval`. What is held back is counted, so that the
// next line can say it.
#pragma once

#include "fusion/time.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

namespace locus {

class RateLimit {
  public:
    RateLimit(double burst, Duration interval) : burst_{burst}, interval_{interval}, tokens_{burst} {}

    /// Empty: hold it back. Else how many were held back since the last one that passed.
    std::optional<std::uint64_t> pass(Timestamp now) {
        const double regained = static_cast<double>((now - last_).count()) / static_cast<double>(interval_.count());
        tokens_ = std::min(burst_, tokens_ + std::max(0.0, regained));
        last_ = now;
        if (tokens_ < 1) {
            ++held_back_;
            return {};
        }
        tokens_ -= 1;
        return std::exchange(held_back_, 0);
    }

  private:
    double burst_;
    Duration interval_;
    double tokens_;
    Timestamp last_{};
    std::uint64_t held_back_ = 0;
};

} // namespace locus
