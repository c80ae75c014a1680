// Broadcast ephemerides: where a satellite will be, in the terms in which it says so itself.
#pragma once

#include "fusion/gnss/gnss_time.h"
#include "fusion/measurement.h"

#include <array>
#include <cstdint>

namespace locus::gnss {

/// GPS, QZSS (IS-GPS-200 table 20-III), Galileo (OS SIS ICD table 57, 60) and BeiDou (BDS-SIS-ICD B1I table 5-10):
/// angles in radians, the rest in metres and seconds. Week and times are of the constellation itself, the week full.
struct KeplerEphemeris {
    std::uint8_t constellation = 0;
    std::uint8_t satellite = 0;
    std::uint16_t issue = 0;       ///< IODE, IODnav, AODE
    std::uint16_t issue_clock = 0; ///< IODC, IODnav, AODC
    std::uint8_t accuracy = 0;     ///< index: URA, SISA
    std::uint8_t health = 0; ///< 0: healthy; as broadcast (Galileo: E5b HS, E1B HS, E5b DVS, E1B DVS from high to low)
    int week = 0;            ///< of toe
    double toe_s = 0, toc_s = 0;
    double clock_s = 0, clock_drift = 0, clock_drift_rate_per_s = 0; ///< af0, af1, af2
    std::array<double, 2> group_delay_s{}; ///< TGD; Galileo: BGD E5a/E1, E5b/E1; BeiDou: TGD1, TGD2
    double root_a = 0, eccentricity = 0, mean_anomaly = 0, mean_motion_difference = 0;
    double inclination = 0, inclination_rate = 0;
    double node = 0, node_rate = 0, perigee = 0; ///< node: at the week's beginning
    double cuc = 0, cus = 0, cic = 0, cis = 0;
    double crc_m = 0, crs_m = 0;

    bool operator==(const KeplerEphemeris&) const = default;
};

/// GLONASS (ICD L1, L2, edition 5.1, table 4.5): a state vector in PZ-90 at the reference time.
struct GlonassEphemeris {
    std::uint8_t satellite = 0;
    std::int8_t frequency = 0; ///< channel, -7 to 6
    std::uint8_t health = 0;   ///< 0: healthy
    std::uint8_t age_days = 0; ///< En
    GpsTime reference;         ///< tb, in GPS time
    double clock_s = 0;        ///< satellite less system, as in KeplerEphemeris: -tau_n
    double clock_drift = 0;    ///< gamma_n
    double frame_s_in_day = 0; ///< tk, Moscow time
    Vec3 position_m{}, velocity_mps{}, acceleration_mps2{};

    bool operator==(const GlonassEphemeris&) const = default;
};

} // namespace locus::gnss
