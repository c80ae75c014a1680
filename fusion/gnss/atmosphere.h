// How much longer the air makes a pseudorange: the ionosphere by Klobuchar's model, the troposphere by Saastamoinen's.
#pragma once

#include "fusion/geometry/earth.h"
#include "fusion/gnss/gnss_time.h"

namespace locus::gnss {

/// As GPS broadcasts them (IS-GPS-200, 20.3.3.5.1.7): seconds, by powers of semicircles of magnetic latitude.
struct Klobuchar {
    std::array<double, 4> alpha{}; ///< amplitude of the day's hump
    std::array<double, 4> beta{};  ///< its period

    bool operator==(const Klobuchar&) const = default;
};

/// Where none came: what GPS broadcast on 2004-01-01, which rtklib falls back on as well.
inline constexpr Klobuchar usual_ionosphere{{0.1118e-7, -0.7451e-8, -0.5961e-7, 0.1192e-6},
                                            {0.1167e6, -0.2294e6, -0.1311e6, 0.1049e7}};

/// Direction to a satellite: azimuth clockwise from north.
struct LookAngles {
    double azimuth_rad = 0;
    double elevation_rad = 0;
};

/// `enu_to_ecef`: of the receiver's place; `towards_ecef`: of any length but 0.
LookAngles look_angles(const Eigen::Matrix3d& enu_to_ecef, const Eigen::Vector3d& towards_ecef) noexcept;

/// IS-GPS-200 figure 20-4: delay of a code at 1575.42 MHz. At another frequency f it is (1575.42 MHz / f)^2 as much,
/// and of a carrier it is the same with the sign turned round.
double ionosphere_l1_m(const Klobuchar& coefficients, const GpsTime& time, const Geodetic& at,
                       const LookAngles& look) noexcept;

/// Saastamoinen, Atmospheric correction for the troposphere and stratosphere in radio ranging of satellites (1972),
/// with the gravity term of Davis and others, Radio Science 20 (1985); pressure and temperature of the International
/// Standard Atmosphere, 70 % humidity. From the zenith to the satellite by the mapping of RTCA DO-229
/// (1.001 / sqrt(0.002001 + sin^2)), good from 4 degrees upwards. 0 outside -1 km to 20 km of height.
double troposphere_m(const Geodetic& at, double elevation_rad) noexcept;

} // namespace locus::gnss
