// A pose as GNSS receivers tell theirs: NMEA 0183 sentences GGA, RMC, VTG, GST and, where the attitude is known, HDT
// (protocols.md 5.2). What is not known stays empty.
#pragma once

#include "config/nmea_settings.h"
#include "fusion/geometry/earth.h"
#include "fusion/pose.h"

#include <string>

namespace locus {

/// UTC as the host's clock has it.
struct UtcTime {
    std::int64_t unix_us = 0;
    bool leap_second = false; ///< the clock stands in one: it repeats 23:59:59, which is 23:59:60
};

/// `estimated`: dead reckoning, nothing that knows the place was heard for a second.
enum class PoseValidity : std::uint8_t { none, estimated, measured };

/// `worst_error_m`: a wider 95 % bound makes a pose none.
PoseValidity validity_of(const Pose& pose, double worst_error_m);

/// All sentences of one moment, each with its checksum and line end. `pose` null: there is none, and the sentences say
/// so.
std::string nmea_sentences(const NmeaOutputSettings& settings, const SiteOnEarth& earth, const Pose* pose,
                           const UtcTime& time);

} // namespace locus
