// The sentences that locate: fields as they stand (protocols.md 5.2), numbers that are empty as NaN.
#pragma once

#include "drivers/gnss/nmea_sentence.h"

namespace locus::gnss::nmea {

/// Position.
struct Gga {
    std::int64_t time_us = no_time; ///< of the day, UTC
    double latitude_deg = not_told;
    double longitude_deg = not_told;
    unsigned quality = 0; ///< 0: no fix
    unsigned satellites = 0;
    double horizontal_dilution = not_told;
    double altitude_sea_level_m = not_told;
    double geoid_separation_m = not_told; ///< geoid above the ellipsoid
};

/// What GNSS must have at the least; here it is read for the velocity.
struct Rmc {
    std::int64_t time_us = no_time;
    bool valid = false;
    double latitude_deg = not_told;
    double longitude_deg = not_told;
    double speed_knots = not_told;
    double course_deg = not_told; ///< true, clockwise from north
    unsigned date_ddmmyy = 0;
    char mode = 0; ///< A: measured, E: estimated, N: not valid; 0: as `valid` says
};

/// Velocity. Without a time: it belongs to the sentence before it.
struct Vtg {
    double course_deg = not_told;
    double speed_knots = not_told;
    char mode = 0; ///< N: not valid; 0: older receivers do not say
};

/// Standard deviations of the position.
struct Gst {
    std::int64_t time_us = no_time;
    double sigma_latitude_m = not_told;
    double sigma_longitude_m = not_told;
    double sigma_altitude_m = not_told;
};

/// Where the bow points.
struct Hdt {
    double heading_deg = not_told; ///< true, clockwise from north
};

/// The same with its status.
struct Ths {
    double heading_deg = not_told; ///< true, clockwise from north
    char mode = 0;                 ///< A: measured; E estimated, M told by hand, S simulated, V: not valid
};

/// Time and date.
struct Zda {
    std::int64_t time_us = no_time;
    unsigned day = 0, month = 0, year = 0;
};

/// Each wants a sentence of its type; empty when a field cannot be read.
std::optional<Gga> parse_gga(const Sentence& sentence);
std::optional<Rmc> parse_rmc(const Sentence& sentence);
std::optional<Vtg> parse_vtg(const Sentence& sentence);
std::optional<Gst> parse_gst(const Sentence& sentence);
std::optional<Zda> parse_zda(const Sentence& sentence);
std::optional<Hdt> parse_hdt(const Sentence& sentence);
std::optional<Ths> parse_ths(const Sentence& sentence);

/// Whole lines with checksum and "\r\n", angles to 1e-7 minutes, other numbers to a thousandth. A
/// time of day beyond the last second is in a leap second.
std::string encode(const Gga& gga);
std::string encode(const Rmc& rmc);
std::string encode(const Vtg& vtg);
std::string encode(const Gst& gst);
std::string encode(const Zda& zda);
std::string encode(const Hdt& hdt);
std::string encode(const Ths& ths);

} // namespace locus::gnss::nmea
