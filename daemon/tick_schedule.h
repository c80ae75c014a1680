// When the ticks are: whole multiples of the period on CLOCK_MONOTONIC, so that neither a reload nor a late tick shifts
// those that follow. Pure.
#pragma once

#include "fusion/time.h"

#include <algorithm>

namespace locus {

class TickSchedule {
  public:
    explicit TickSchedule(Duration period) : period_{period} {}

    /// The first tick after `now` that also lies after every earlier one. Ticks missed meanwhile are left out.
    Timestamp next(Timestamp now) {
        const Duration after = std::max(now, last_).time_since_epoch();
        last_ = Timestamp{(after / period_ + 1) * period_};
        return last_;
    }

    void set_period(Duration period) { period_ = period; }
    Duration period() const { return period_; }

  private:
    Duration period_;
    Timestamp last_{};
};

inline Duration period_of(double rate_hz) { return duration_from_s(1 / rate_hz); }

} // namespace locus
