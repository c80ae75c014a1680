#include "fusion/gnss/sight_from.h"

#include "fusion/gnss/signals.h"

#include <cmath>
#include <numbers>

namespace locus::gnss {

Observer::Observer(const GnssSettings& settings)
    : settings_{settings}, mask_rad_{settings.elevation_mask_deg * std::numbers::pi / 180} {}

void Observer::turn(std::span<SightFrom> sights, const Eigen::Vector3d& from_ecef_m) noexcept {
    for (SightFrom& s : sights) {
        const double travel_s = (s.sight.satellite_ecef_m - from_ecef_m).norm() / light_mps;
        s.satellite_ecef_m = turned(s.sight.satellite_ecef_m, travel_s);
        s.velocity_ecef_mps = turned(s.sight.velocity_ecef_mps, travel_s);
        s.towards = (s.satellite_ecef_m - from_ecef_m).normalized();
        s.range_m = s.sight.code_m;
        s.carrier_m = s.sight.carrier_m;
        s.variance_m2 = s.rate_variance_m2ps2 = 1;
    }
}

void Observer::observe(std::span<SightFrom> sights, const Sky& sky, const Eigen::Vector3d& from_ecef_m) const noexcept {
    turn(sights, from_ecef_m);
    const Geodetic at = geodetic(from_ecef_m);
    const Eigen::Matrix3d axes = enu_to_ecef(at);
    for (SightFrom& s : sights) {
        if (s.reason != Exclusion::none && s.reason != Exclusion::too_low) continue;
        const LookAngles look = look_angles(axes, s.towards);
        s.reason = look.elevation_rad < mask_rad_ ? Exclusion::too_low : Exclusion::none;
        if (s.reason != Exclusion::none) continue;
        take_out_air(s, sky, at, look);
        correct(s, from_ecef_m, at.height_ellipsoid_m);
    }
}

void Observer::take_out_air(SightFrom& s, const Sky& sky, const Geodetic& at, const LookAngles& look) const noexcept {
    const double slower = std::pow(carrier_hz(constellation::gps, 0) / s.sight.carrier_hz, 2);
    const double ionosphere_m = slower * ionosphere_l1_m(sky.ionosphere.value_or(usual_ionosphere), sky.time, at, look);
    const double air_m = troposphere_m(at, look.elevation_rad);
    Reception of = s.sight.reception;
    of.elevation_rad = s.elevation_rad = look.elevation_rad;
    s.range_m = s.sight.code_m - ionosphere_m - air_m;
    if (s.sight.carrier_m != 0) s.carrier_m = s.sight.carrier_m + ionosphere_m - air_m;
    s.variance_m2 = code_variance_m2(settings_, of) + ionosphere_variance_m2(ionosphere_m, sky.ionosphere.has_value()) +
                    troposphere_variance_m2(look.elevation_rad);
    s.rate_variance_m2ps2 = rate_variance_m2ps2(settings_, of);
}

/// Orbit and air are the base's as well; its multipath and noise come in for them. A base that is far off, or hears the
/// satellite badly, would make things worse.
void Observer::correct(SightFrom& s, const Eigen::Vector3d& at_ecef_m, double height_m) const noexcept {
    s.is_corrected = false;
    if (!s.correction) return;
    Reception of = s.sight.reception;
    of.elevation_rad = s.elevation_rad;
    const double variance_m2 = reception_variance_m2(settings_, of) + s.correction->variance_m2 +
                               distance_variance_m2(settings_, *s.correction, at_ecef_m, height_m, s.elevation_rad);
    if (!(variance_m2 < s.variance_m2)) return;
    s.is_corrected = true;
    s.range_m -= s.correction->code_m;
    s.variance_m2 = variance_m2;
}

} // namespace locus::gnss
