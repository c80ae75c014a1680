// One pseudorange of a base station as the bases' book keeps it.
#pragma once

#include "fusion/gnss/sight_from.h"
#include "fusion/gnss/signals.h"

#include <cmath>

namespace locus::gnss {

inline std::size_t base_clock(std::uint8_t constellation) { return static_cast<std::size_t>(clock_of(constellation)); }
inline std::size_t base_clock(const SightFrom& s) { return base_clock(s.sight.reception.constellation); }

/// From one second of the week to another, the shorter way round.
inline double since_s(double then_s, double now_s) { return std::remainder(now_s - then_s, week_s); }

inline bool is_heard(const GnssBaseRange& range) { return range.pseudorange_m > 0; }

/// As a receiver at the base would have told it.
inline GnssRaw raw_of(const GnssBaseRange& range, const GpsTime& received) {
    GnssRaw raw;
    raw.receiver_time_s_in_gps_week = received.second;
    raw.gps_week = static_cast<std::uint16_t>(received.week);
    raw.pseudorange_m = range.pseudorange_m;
    raw.carrier_to_noise_dbhz = range.carrier_to_noise_dbhz;
    raw.constellation = range.constellation;
    raw.satellite = range.satellite;
    raw.signal = range.signal;
    raw.glonass_slot = range.glonass_slot;
    return raw;
}

} // namespace locus::gnss
