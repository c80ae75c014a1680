#include "fusion/geometry/earth.h"

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/NormalGravity.hpp>

#include <cmath>
#include <numbers>

namespace locus {

Eigen::Vector3d ecef_m(const Geodetic& at) noexcept {
    Eigen::Vector3d position_m;
    GeographicLib::Geocentric::WGS84().Forward(at.latitude_deg, at.longitude_deg, at.height_ellipsoid_m, position_m[0],
                                               position_m[1], position_m[2]);
    return position_m;
}

Geodetic geodetic(const Eigen::Vector3d& position_ecef_m) noexcept {
    Geodetic at;
    GeographicLib::Geocentric::WGS84().Reverse(position_ecef_m[0], position_ecef_m[1], position_ecef_m[2],
                                               at.latitude_deg, at.longitude_deg, at.height_ellipsoid_m);
    return at;
}

Eigen::Matrix3d enu_to_ecef(const Geodetic& at) noexcept {
    constexpr double radians = std::numbers::pi / 180;
    const double sin_lat = std::sin(at.latitude_deg * radians), cos_lat = std::cos(at.latitude_deg * radians);
    const double sin_lon = std::sin(at.longitude_deg * radians), cos_lon = std::cos(at.longitude_deg * radians);
    return (Eigen::Matrix3d() << -sin_lon, -sin_lat * cos_lon, cos_lat * cos_lon, //
            cos_lon, -sin_lat * sin_lon, cos_lat * sin_lon,                       //
            0, cos_lat, sin_lat)
        .finished();
}

Eigen::Vector3d gravity_ecef_mps2(const Eigen::Vector3d& position_ecef_m) noexcept {
    Eigen::Vector3d gravity;
    GeographicLib::NormalGravity::WGS84().U(position_ecef_m[0], position_ecef_m[1], position_ecef_m[2], gravity[0],
                                            gravity[1], gravity[2]);
    return gravity;
}

SiteOnEarth::SiteOnEarth(const Wgs84Anchor& origin) noexcept {
    const Geodetic at{origin.latitude_deg, origin.longitude_deg, origin.height_ellipsoid_m};
    origin_ecef_m_ = locus::ecef_m(at);
    const double from_east_rad = (90 - origin.x_axis_heading_deg) * std::numbers::pi / 180;
    to_ecef_ = enu_to_ecef(at) * Eigen::AngleAxisd(from_east_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

} // namespace locus
