// Where a satellite is and what its clock shows, from its broadcast ephemeris.
#pragma once

#include "fusion/gnss/ephemeris.h"

namespace locus::gnss {

/// Earth-fixed: of the instant itself, no rotation for the way of the signal.
struct SatelliteState {
    Vec3 position_ecef_m{};
    Vec3 velocity_ecef_mps{};
    double clock_s = 0; ///< satellite less system time, with the relativistic term, without group delays
    double clock_drift = 0;
};

/// IS-GPS-200 table 20-IV and 20.3.3.3.3.1; Galileo OS SIS ICD table 58 and 5.1.4; BDS-SIS-ICD B1I table 5-11. At a GPS
/// time, best within two hours of toe. Not finite for elements that describe no orbit.
SatelliteState satellite_state(const KeplerEphemeris& ephemeris, const GpsTime& time) noexcept;

/// GLONASS ICD 5.1, appendix 3.1.2: Runge-Kutta of fourth order in steps of at most 60 s. At most half a day from the
/// reference time: beyond, not finite.
SatelliteState satellite_state(const GlonassEphemeris& ephemeris, const GpsTime& time) noexcept;

} // namespace locus::gnss
