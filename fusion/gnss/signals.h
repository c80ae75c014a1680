// The signals that are used: of each satellite the one at L1, because its broadcast clock and the coefficients of the
// ionosphere go with it. Numbers of signals are sigId of u-blox.
#pragma once

#include "fusion/measurement.h"

namespace locus::gnss {

/// GPS and QZSS L1 C/A, Galileo E1 (B or C), BeiDou B1I (D1 or D2), GLONASS L1.
constexpr bool is_used_signal(std::uint8_t constellation, std::uint8_t signal) {
    switch (constellation) {
    case constellation::gps:
    case constellation::qzss:
    case constellation::glonass:
        return signal == 0;
    case constellation::galileo:
    case constellation::beidou:
        return signal <= 1;
    default:
        return false;
    }
}

/// Carrier of such a signal: IS-GPS-200 3.3.1.1; BDS-SIS-ICD B1I 4.2.1; GLONASS ICD 5.1, 3.3.1.1. `glonass_slot`:
/// channel + 7.
constexpr double carrier_hz(std::uint8_t constellation, std::uint8_t glonass_slot) {
    if (constellation == constellation::beidou) return 1561.098e6;
    if (constellation == constellation::glonass) return 1602e6 + (glonass_slot - 7) * 562.5e3;
    return 1575.42e6;
}

/// Receiver clocks, one for each constellation: GPS with QZSS, Galileo, BeiDou, GLONASS.
inline constexpr int clock_count = 4;

constexpr int clock_of(std::uint8_t constellation) {
    switch (constellation) {
    case constellation::galileo:
        return 1;
    case constellation::beidou:
        return 2;
    case constellation::glonass:
        return 3;
    default:
        return 0;
    }
}

} // namespace locus::gnss
