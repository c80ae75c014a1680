// What a base station measured of a satellite beyond what the models say, and how far that holds elsewhere. The models
// (broadcast orbit and clock, Klobuchar, Saastamoinen) are applied at the base as at the receiver, with the same
// ephemeris, so a correction is only what they leave: some metres. Where it comes to an end, nothing jumps by more.
#pragma once

#include "fusion/gnss/range_noise.h"

#include <Eigen/Core>

namespace locus::gnss {

struct Correction {
    double code_m = 0;      ///< measured less modelled, the base's clock taken out
    double variance_m2 = 0; ///< of the base's own multipath and noise, and of what has changed since
    Eigen::Vector3d base_ecef_m{0, 0, 0};
    double base_height_m = 0; ///< over the ellipsoid
};

/// Orbits and satellites' clocks wander by no more than 0.006 m/s in 95 % (GPS SPS Performance Standard 2020, table
/// 3.4-2: error of the range's rate).
inline double ageing_variance_m2(double age_s) {
    constexpr double rate_sigma_mps = 0.003;
    return std::pow(rate_sigma_mps * age_s, 2);
}

/// A thin shell at 350 km (RTCA DO-229, A.4.4.10.4).
inline double ionosphere_slant(double elevation_rad) {
    constexpr double earth_m = 6378136.3, shell_m = 350e3;
    return 1 / std::sqrt(1 - std::pow(earth_m * std::cos(elevation_rad) / (earth_m + shell_m), 2));
}

/// What of the air differs between base and receiver: the ionosphere by its gradient, of the troposphere the model's
/// error as far as the one stands in air that the other does not have above it (as RTCA DO-253 counts it, with 7 km).
inline double distance_variance_m2(const GnssSettings& settings, const Correction& correction,
                                   const Eigen::Vector3d& at_ecef_m, double height_m, double elevation_rad) {
    constexpr double air_m = 7000;
    const double distance_km = (at_ecef_m - correction.base_ecef_m).norm() / 1000;
    const double share = 1 - std::exp(-std::abs(height_m - correction.base_height_m) / air_m);
    return std::pow(settings.ionosphere_gradient_mpkm * distance_km * ionosphere_slant(elevation_rad), 2) +
           share * share * troposphere_variance_m2(elevation_rad);
}

} // namespace locus::gnss
