#include "fusion/gnss/satellite_range.h"

#include <algorithm>
#include <cmath>

namespace locus::gnss {
namespace {

float sigma_of(double variance) { return static_cast<float>(std::sqrt(variance)); }

void put_velocity(GnssFix& fix, const Eigen::Vector3d& velocity_ecef_mps, double variance_m2ps2,
                  const Eigen::Matrix3d& axes) {
    const Eigen::Vector3d enu_mps = axes.transpose() * velocity_ecef_mps;
    for (int i = 0; i < 3; ++i) fix.velocity_enu_mps[static_cast<std::size_t>(i)] = static_cast<float>(enu_mps[i]);
    fix.sigma_velocity_mps = sigma_of(variance_m2ps2);
}

} // namespace

SatelliteRange satellite_range(const GnssRaw& raw, const SightFrom& from) noexcept {
    SatelliteRange range;
    range.tag = raw.tag;
    for (int i = 0; i < 3; ++i) {
        const auto axis = static_cast<std::size_t>(i);
        range.satellite_ecef_m[axis] = from.satellite_ecef_m[i];
        range.satellite_velocity_ecef_mps[axis] = static_cast<float>(from.velocity_ecef_mps[i]);
    }
    if (from.rate_agrees) range.range_rate_mps = static_cast<float>(from.sight.rate_mps);
    range.pseudorange_m = from.range_m;
    range.carrier_m = from.carrier_m;
    range.sigma_m = sigma_of(from.variance_m2);
    range.sigma_rate_mps = sigma_of(from.rate_variance_m2ps2);
    range.carrier_to_noise_dbhz = raw.carrier_to_noise_dbhz;
    range.lock_s = raw.lock_s;
    range.constellation = raw.constellation;
    range.satellite = raw.satellite;
    range.signal = raw.signal;
    return range;
}

GnssFix own_fix(Address tag, const SinglePoint& point) noexcept {
    const Geodetic at = geodetic(point.position_ecef_m);
    const Eigen::Matrix3d axes = enu_to_ecef(at);
    const Eigen::Matrix3d enu_m2 = axes.transpose() * point.covariance_m2 * axes;
    GnssFix fix;
    fix.tag = tag;
    fix.latitude_deg = at.latitude_deg;
    fix.longitude_deg = at.longitude_deg;
    fix.height_ellipsoid_m = at.height_ellipsoid_m;
    fix.sigma_horizontal_m = sigma_of((enu_m2(0, 0) + enu_m2(1, 1)) / 2);
    fix.sigma_vertical_m = sigma_of(enu_m2(2, 2));
    if (point.velocity_ecef_mps)
        put_velocity(fix, *point.velocity_ecef_mps, point.velocity_covariance_m2ps2.trace() / 3, axes);
    fix.fix_type = 2 * point.corrected > point.satellites ? gnss_fix_type::differential : gnss_fix_type::full;
    fix.satellites = static_cast<std::uint8_t>(std::min(point.satellites, 255));
    return fix;
}

} // namespace locus::gnss
