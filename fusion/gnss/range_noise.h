// How far a pseudorange and a Doppler are to be believed: the one model by which single points are weighted and whose
// standard deviations go out with each SatelliteRange. Sources of the figures: settings.h.
#pragma once

#include "fusion/gnss/settings.h"
#include "fusion/measurement.h"

#include <algorithm>
#include <cmath>

namespace locus::gnss {

/// What is known of a signal besides its range.
struct Reception {
    std::uint8_t constellation = 0;
    double elevation_rad = 0;
    float carrier_to_noise_dbhz = unknown_f;
    float noise_m = unknown_f; ///< as the receiver states it
    double orbit_times = 1;    ///< how much worse the satellite says that its orbit and clock are than at their best
};

inline double carrier_to_noise_or_usual(float dbhz) {
    constexpr double usual_dbhz = 40;
    return std::isfinite(dbhz) ? double{dbhz} : usual_dbhz;
}

inline double noise_variance_m2(const GnssSettings& settings, const Reception& of) {
    constexpr float worst_m = 1e4F;
    if (std::isfinite(of.noise_m) && of.noise_m > 0) return std::pow(double{std::min(of.noise_m, worst_m)}, 2);
    return settings.noise_at_0_dbhz_m * settings.noise_at_0_dbhz_m *
           std::pow(10, -carrier_to_noise_or_usual(of.carrier_to_noise_dbhz) / 10);
}

/// Multipath and noise.
inline double reception_variance_m2(const GnssSettings& settings, const Reception& of) {
    const double sine = std::max(0.05, std::sin(of.elevation_rad));
    const double factor = of.constellation == constellation::glonass ? 1.5 : 1;
    return std::pow(factor * settings.code_sigma_m, 2) * (1 + 1 / sine) + noise_variance_m2(settings, of);
}

/// Orbit and clock, multipath and noise; of the air nothing.
inline double code_variance_m2(const GnssSettings& settings, const Reception& of) {
    return std::pow(of.orbit_times * settings.orbit_sigma_m, 2) + reception_variance_m2(settings, of);
}

/// Half the delay is left after Klobuchar's model (IS-GPS-200, 20.3.3.5.2.5); all of it when its coefficients are the
/// usual ones.
inline double ionosphere_variance_m2(double delay_m, bool broadcast) {
    return std::pow(broadcast ? 0.5 * delay_m : delay_m, 2);
}

/// rtklib's: 0.3 m / (sin + 0.1).
inline double troposphere_variance_m2(double elevation_rad) {
    return std::pow(0.3 / (std::max(0.0, std::sin(elevation_rad)) + 0.1), 2);
}

inline double rate_variance_m2ps2(const GnssSettings& settings, const Reception& of) {
    constexpr double strong_dbhz = 45;
    const double weaker_dbhz = strong_dbhz - carrier_to_noise_or_usual(of.carrier_to_noise_dbhz);
    return settings.rate_sigma_mps * settings.rate_sigma_mps * (1 + std::pow(10, weaker_dbhz / 10));
}

} // namespace locus::gnss
