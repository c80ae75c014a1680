#include "drivers/gnss/epoch_clock.h"

namespace locus::gnss {

Timestamp EpochClock::host_time(std::int64_t told_ns, Timestamp received) {
    const std::int64_t step_ns = begun_ ? since_last_ns(told_ns) : 0;
    if (step_ns < 0 && step_ns >= -overtaken_ns) return said_ + Duration{step_ns};
    begun_ = true;
    told_ns_ = told_ns;
    count_ns_ += static_cast<std::uint64_t>(step_ns);
    return said_ = clock_.host_time(count_ns_, received);
}

void EpochClock::reset() {
    begun_ = false;
    clock_.reset();
}

/// The way round the period that is shorter. A day of UTC with a leap second has one second more: 23:59:60.
std::int64_t EpochClock::since_last_ns(std::int64_t told_ns) const {
    constexpr std::int64_t second_ns = 1'000'000'000;
    const std::int64_t long_day_ns = told_ns_ >= period_ns_ && told_ns < period_ns_ ? second_ns : 0;
    std::int64_t step_ns = (told_ns - told_ns_) % period_ns_;
    if (step_ns > period_ns_ / 2) step_ns -= period_ns_;
    if (step_ns < -period_ns_ / 2) step_ns += period_ns_;
    return step_ns + long_day_ns;
}

} // namespace locus::gnss
