// The way back from an ephemeris to the words that a satellite broadcasts: what is known only as printed values (RINEX)
// goes into the fusion like what a receiver hears.
#pragma once

#include "fusion/gnss/atmosphere.h"
#include "fusion/gnss/ephemeris_collector.h"

#include <vector>

namespace locus::gnss {

/// One GnssNavigation for each subframe, page or string that EphemerisCollector needs, without tag. `sent`: GPS time of
/// the broadcast; `leap_s`: GPS time less UTC. Empty when a value has no room in its field, or the constellation is
/// none of those.
std::vector<GnssNavigation> encode(const Ephemeris& ephemeris, const GpsTime& sent, int leap_s);

/// The page of a GPS satellite that tells the ionosphere, likewise.
std::optional<GnssNavigation> encode(const Klobuchar& coefficients, std::uint8_t gps_satellite, const GpsTime& sent);

} // namespace locus::gnss
