// The one place below the daemon that reads the clock. fusion/ must not include it: time comes in with measurements.
#pragma once

#include "fusion/time.h"

#include <ctime>

namespace locus {

inline Timestamp read_clock(clockid_t clock) {
    timespec now{};
    ::clock_gettime(clock, &now);
    return timestamp_from_ns(std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec);
}

inline Timestamp monotonic_now() { return read_clock(CLOCK_MONOTONIC); }

/// A packet's receive stamp: whole microseconds, because a recording holds no more, and a replay must see what the live
/// run saw.
constexpr Timestamp receive_stamp(Timestamp time) { return std::chrono::floor<std::chrono::microseconds>(time); }

} // namespace locus
