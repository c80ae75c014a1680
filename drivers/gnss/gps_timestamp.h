// Recordings of receivers have no stamps of a host: their clock is GPS time, seconds since 1980-01-06.
#pragma once

#include "fusion/gnss/gnss_time.h"
#include "fusion/time.h"

#include <cmath>

namespace locus::gnss {

inline Timestamp timestamp(const GpsTime& time) {
    constexpr std::int64_t week_ns = 604'800'000'000'000;
    return timestamp_from_ns(time.week * week_ns + std::llround(time.second * 1e9));
}

} // namespace locus::gnss
