// When a base station measured, as each constellation tells it, in seconds of the GPS week.
#pragma once

#include "fusion/gnss/calendar.h"

#include <cstdint>
#include <optional>

namespace locus::gnss::rtcm3 {

/// GPS, Galileo, QZSS (DF004, DF248, DF428): milliseconds of the week.
inline std::optional<double> gps_second(std::uint64_t ms) {
    const double second = static_cast<double>(ms) * 1e-3;
    return second < week_s ? std::optional{second} : std::nullopt;
}

/// DF427: milliseconds of BeiDou's week.
inline std::optional<double> gps_second_of_beidou(std::uint64_t ms) {
    const auto second = gps_second(ms);
    if (!second) return std::nullopt;
    return (GpsTime{0, second.value()} + gps_minus_beidou_s).second;
}

/// DF416 and DF034: day of the week, 0 for Sunday (7: not known), and milliseconds of the day in UTC + 3 h. Which year
/// it is nobody says, so the leap seconds are the newest of the table.
inline std::optional<double> gps_second_of_glonass(std::uint64_t day, std::uint64_t ms) {
    constexpr double day_s = 86400, moscow_s = 10800;
    const double second = static_cast<double>(ms) * 1e-3;
    if (day > 6 || second > day_s + 1) return std::nullopt;
    const double since_sunday_s = static_cast<double>(day) * day_s + second - moscow_s;
    return (GpsTime{0, since_sunday_s} + leap_seconds({2199, 1, 1})).second;
}

} // namespace locus::gnss::rtcm3
