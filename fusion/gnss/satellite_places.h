// A place for each satellite of the constellations that are used, so that what is known of them lies in one row.
#pragma once

#include "fusion/measurement.h"

#include <cstddef>

namespace locus::gnss {

namespace satellite_places {
inline constexpr std::size_t gps = 32, qzss = 10, galileo = 36, beidou = 63, glonass = 32;
inline constexpr std::size_t all = gps + qzss + galileo + beidou + glonass;
inline constexpr std::size_t nowhere = all;
} // namespace satellite_places

/// nowhere: there is no such satellite.
constexpr std::size_t satellite_place(std::uint8_t constellation, std::uint8_t satellite) noexcept {
    using namespace satellite_places;
    const auto place = [&](std::size_t begin, std::size_t count) {
        return satellite >= 1 && satellite <= count ? begin + satellite - 1 : nowhere;
    };
    switch (constellation) {
    case constellation::gps:
        return place(0, gps);
    case constellation::qzss:
        return place(gps, qzss);
    case constellation::galileo:
        return place(gps + qzss, galileo);
    case constellation::beidou:
        return place(gps + qzss + galileo, beidou);
    case constellation::glonass:
        return place(gps + qzss + galileo + beidou, glonass);
    default:
        return nowhere;
    }
}

} // namespace locus::gnss
