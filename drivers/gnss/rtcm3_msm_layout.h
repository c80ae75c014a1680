// What the number of a multiple signal message says: constellation, kind of fields, and which signals are used.
#pragma once

#include "fusion/gnss/beidou_d1.h"
#include "fusion/measurement.h"

#include <optional>

namespace locus::gnss::rtcm3 {

/// Bits of the fields that kinds 4 to 7 have and that are read; rest: what lies between or behind.
struct Layout {
    bool extended = false; ///< of a satellite: extended information, and a rough rate behind
    unsigned fine = 15;    ///< pseudorange of a cell, in 2^-24 or 2^-29 ms
    double fine_unit_ms = 0x1p-24;
    std::size_t between = 22 + 4 + 1; ///< carrier, lock, half-cycle flag
    unsigned strength = 6;            ///< C/N0 in 1 or 2^-4 dBHz
    float strength_unit_dbhz = 1;
    std::size_t behind = 0; ///< rate

    std::size_t satellite_bits() const { return 8 + 10 + (extended ? 4 + 14 : 0); }
    std::size_t cell_bits() const { return fine + between + strength + behind; }
};

inline Layout layout_of(unsigned number) {
    const unsigned kind = number % 10;
    Layout layout;
    layout.extended = kind == 5 || kind == 7;
    layout.behind = layout.extended ? 15 : 0;
    if (kind < 6) return layout;
    layout.fine = 20;
    layout.fine_unit_ms = 0x1p-29;
    layout.between = 24 + 10 + 1;
    layout.strength = 10;
    layout.strength_unit_dbhz = 0x1p-4F;
    return layout;
}

inline std::optional<std::uint8_t> constellation_of(unsigned number) {
    switch (number / 10) {
    case 107:
        return constellation::gps;
    case 108:
        return constellation::glonass;
    case 109:
        return constellation::galileo;
    case 111:
        return constellation::qzss;
    case 112:
        return constellation::beidou;
    default:
        return std::nullopt;
    }
}

/// Numbers of DF395 (tables 3.5-91, -96, -99, -105, -108) that are at L1 and on the codes that the satellite's clock
/// goes with: C/A; Galileo E1 C, B, B + C; BeiDou B1I. As sigId of u-blox.
inline std::optional<std::uint8_t> signal_of(std::uint8_t constellation, std::uint8_t satellite, unsigned number) {
    constexpr unsigned first = 2, galileo_b = 4, galileo_both = 5;
    if (constellation == constellation::galileo && number == galileo_b) return 1;
    if (constellation == constellation::galileo && number == galileo_both) return 0;
    if (number != first) return std::nullopt;
    return constellation == constellation::beidou && beidou_geostationary(satellite) ? 1 : 0;
}

} // namespace locus::gnss::rtcm3
