// What can be set of the output as NMEA 0183. Where the defaults come from: 5 Hz is what a line of 38400 baud takes of
// these five sentences with room to spare.
#pragma once

#include "fusion/option.h"

#include <array>
#include <string>

namespace locus {

struct NmeaOutputSettings {
    std::string target;
    std::string link = "/run/locusd/nmea";
    double rate_hz = 5;
    double geoid_height_m = 0;
    double worst_error_m = 100;
};

inline constexpr std::array nmea_output_options{
    option<&NmeaOutputSettings::target>("target",
                                        "Name of the target whose pose is told; left out: there is no NMEA output."),
    option<&NmeaOutputSettings::link>("link",
                                      "Path of the pseudo-terminal that GNSS software opens; made by the daemon."),
    option<&NmeaOutputSettings::rate_hz>("rate_hz", "Hz", 0.1, 50, "How often each sentence is told."),
    option<&NmeaOutputSettings::geoid_height_m>(
        "geoid_height_m", "m", -200, 200,
        "Sea level over the ellipsoid at the site (geoid undulation): GGA tells heights over the sea."),
    option<&NmeaOutputSettings::worst_error_m>(
        "worst_error_m", "m", 0.01, 1e6,
        "A pose whose horizontal 95 % bound is wider than this is told as none: RMC status V, GGA quality 0."),
};

} // namespace locus
