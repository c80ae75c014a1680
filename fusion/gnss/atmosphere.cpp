#include "fusion/gnss/atmosphere.h"

#include "fusion/gnss/interface_pi.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace locus::gnss {
namespace {

constexpr double semicircles_per_deg = 1.0 / 180;
constexpr double lowest_air_m = -1000, highest_air_m = 20000;

double of_powers(const std::array<double, 4>& c, double x) { return c[0] + x * (c[1] + x * (c[2] + x * c[3])); }

/// Where the ray goes through the layer, in semicircles.
struct PiercePoint {
    double magnetic_latitude, longitude;
};

PiercePoint pierce_point(const Geodetic& at, const LookAngles& look) {
    const double angle = 0.0137 / (look.elevation_rad / interface_pi + 0.11) - 0.022;
    const double latitude =
        std::clamp(at.latitude_deg * semicircles_per_deg + angle * std::cos(look.azimuth_rad), -0.416, 0.416);
    const double longitude =
        at.longitude_deg * semicircles_per_deg + angle * std::sin(look.azimuth_rad) / std::cos(latitude * interface_pi);
    return {latitude + 0.064 * std::cos((longitude - 1.617) * interface_pi), longitude};
}

/// ISA up to the tropopause, where it goes on as at 11 km.
struct Air {
    double pressure_hpa, temperature_k, vapour_hpa;
};

Air air_at(double height_m) {
    constexpr double humidity = 0.7, tropopause_m = 11000;
    const double h_m = std::clamp(height_m, 0.0, tropopause_m);
    const double temperature_k = 288.15 - 6.5e-3 * h_m;
    return {1013.25 * std::pow(1 - 2.2557e-5 * h_m, 5.2568), temperature_k,
            6.108 * humidity * std::exp((17.15 * temperature_k - 4684) / (temperature_k - 38.45))};
}

double zenith_delay_m(const Geodetic& at) {
    const Air air = air_at(at.height_ellipsoid_m);
    const double latitude_rad = at.latitude_deg * std::numbers::pi / 180;
    const double gravity = 1 - 0.00266 * std::cos(2 * latitude_rad) - 0.00028 * at.height_ellipsoid_m / 1000;
    const double dry_m = 0.0022768 * air.pressure_hpa / gravity;
    return dry_m + 0.002277 * (1255 / air.temperature_k + 0.05) * air.vapour_hpa;
}

} // namespace

LookAngles look_angles(const Eigen::Matrix3d& enu_to_ecef, const Eigen::Vector3d& towards_ecef) noexcept {
    const Eigen::Vector3d enu = enu_to_ecef.transpose() * towards_ecef.normalized();
    return {std::atan2(enu.x(), enu.y()), std::asin(std::clamp(enu.z(), -1.0, 1.0))};
}

double ionosphere_l1_m(const Klobuchar& coefficients, const GpsTime& time, const Geodetic& at,
                       const LookAngles& look) noexcept {
    constexpr double day_s = 86400, night_s = 5e-9, noon_s = 50400;
    const PiercePoint point = pierce_point(at, look);
    const double local_s = 43200 * point.longitude + time.second;
    const double of_day_s = local_s - day_s * std::floor(local_s / day_s);
    const double slant = 1 + 16 * std::pow(0.53 - look.elevation_rad / interface_pi, 3);
    const double amplitude_s = std::max(0.0, of_powers(coefficients.alpha, point.magnetic_latitude));
    const double period_s = std::max(72000.0, of_powers(coefficients.beta, point.magnetic_latitude));
    const double x = 2 * interface_pi * (of_day_s - noon_s) / period_s, x2 = x * x;
    const double hump_s = std::abs(x) < 1.57 ? amplitude_s * (1 - x2 / 2 + x2 * x2 / 24) : 0;
    return light_mps * slant * (night_s + hump_s);
}

double troposphere_m(const Geodetic& at, double elevation_rad) noexcept {
    if (!(at.height_ellipsoid_m > lowest_air_m && at.height_ellipsoid_m < highest_air_m)) return 0;
    const double sine = std::max(0.0, std::sin(elevation_rad));
    return zenith_delay_m(at) * 1.001 / std::sqrt(0.002001 + sine * sine);
}

} // namespace locus::gnss
