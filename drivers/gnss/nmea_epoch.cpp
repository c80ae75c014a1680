#include "drivers/gnss/nmea_epoch.h"

#include <cmath>
#include <numbers>

namespace locus::gnss::nmea {
namespace {

constexpr double mps_per_knot = 1852.0 / 3600;

/// The geoid lies between 107 m under the ellipsoid and 86 m over it (EGM96): when the receiver does not say where,
/// the altitude stands for the height, and this (a uniform spread over that) joins its sigma.
constexpr double sigma_geoid_m = (107 + 86) / 3.4641;

/// GPS Standard Positioning Service Performance Standard, 5th ed., table 3.8-3: 8 m horizontally and 13 m vertically
/// (95 %), which is 2.0 times the sigma of one horizontal axis. GGA tells no vertical dilution.
constexpr double vertical_to_horizontal = (13 / 1.960) / (8 / 2.448);

/// Of the qualities of GGA; none: no measurement.
constexpr std::array<std::uint8_t, 10> fix_types{
    gnss_fix_type::none,          gnss_fix_type::full,          gnss_fix_type::differential,   gnss_fix_type::full,
    gnss_fix_type::carrier_fixed, gnss_fix_type::carrier_float, gnss_fix_type::dead_reckoning, gnss_fix_type::none,
    gnss_fix_type::full,          gnss_fix_type::none,
};

} // namespace

void Epoch::set_velocity(double speed_knots, double course_deg) {
    const double speed_mps = speed_knots * mps_per_knot, course_rad = course_deg * std::numbers::pi / 180;
    velocity_enu_mps_ = {static_cast<float>(speed_mps * std::sin(course_rad)),
                         static_cast<float>(speed_mps * std::cos(course_rad)), 0};
    if (!std::isfinite(velocity_enu_mps_[0]) || !std::isfinite(velocity_enu_mps_[1])) velocity_enu_mps_ = unknown_vec3f;
}

void Epoch::add(const Rmc& rmc) {
    kinds_ |= velocity;
    rmc_came_ = true;
    if (rmc.valid) set_velocity(rmc.speed_knots, rmc.course_deg);
}

void Epoch::add(const Vtg& vtg) {
    kinds_ |= velocity;
    if (!rmc_came_ && vtg.mode != 'N') set_velocity(vtg.speed_knots, vtg.course_deg);
}

std::optional<GnssFix> Epoch::fix(Address tag, double range_error_m) const {
    const bool place = std::isfinite(gga_.latitude_deg) && std::isfinite(gga_.longitude_deg);
    if (!place || !std::isfinite(gga_.altitude_sea_level_m)) return std::nullopt;
    GnssFix fix;
    fix.fix_type = fix_types.at(gga_.quality);
    if (fix.fix_type == gnss_fix_type::none) return std::nullopt;
    fix.tag = tag;
    fix.latitude_deg = gga_.latitude_deg;
    fix.longitude_deg = gga_.longitude_deg;
    const bool geoid_told = std::isfinite(gga_.geoid_separation_m);
    fix.height_ellipsoid_m = gga_.altitude_sea_level_m + (geoid_told ? gga_.geoid_separation_m : 0);
    fix.velocity_enu_mps = velocity_enu_mps_;
    fix.satellites = static_cast<std::uint8_t>(gga_.satellites);
    // The two axes as one: their mean square. Of a dilution each axis has half.
    double horizontal_m = std::hypot(gst_.sigma_latitude_m, gst_.sigma_longitude_m) / std::numbers::sqrt2;
    if (!std::isfinite(horizontal_m)) horizontal_m = gga_.horizontal_dilution * range_error_m / std::numbers::sqrt2;
    double vertical_m = gst_.sigma_altitude_m;
    if (!std::isfinite(vertical_m)) vertical_m = horizontal_m * vertical_to_horizontal;
    fix.sigma_horizontal_m = static_cast<float>(horizontal_m);
    fix.sigma_vertical_m = static_cast<float>(geoid_told ? vertical_m : std::hypot(vertical_m, sigma_geoid_m));
    return fix;
}

} // namespace locus::gnss::nmea
