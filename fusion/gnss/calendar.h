// Dates as receivers and files print them, in GPS time.
#pragma once

#include "fusion/gnss/gnss_time.h"

#include <optional>

namespace locus::gnss {

struct CivilTime {
    int year = 0;
    int month = 0, day = 0, hour = 0, minute = 0;
    double second = 0; ///< 60 and more in a leap second

    bool operator==(const CivilTime&) const = default;
};

/// Of a date that is counted without leap seconds, as GPS, Galileo and BeiDou count; BeiDou's as if it were GPS time.
/// Empty when there is no such date, or it is before 1980-01-06 or after 2200.
std::optional<GpsTime> gps_time(const CivilTime& date);

/// Of a date in UTC, which GLONASS and NMEA count.
std::optional<GpsTime> gps_time_of_utc(const CivilTime& date);

/// GPS time less UTC at a date in UTC, by IERS bulletin C up to that of July 2026: no leap second is announced after
/// that of the end of 2016.
int leap_seconds(const CivilTime& date);

} // namespace locus::gnss
