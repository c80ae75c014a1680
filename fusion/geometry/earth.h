// The site on the Earth: geodetic coordinates (WGS-84), Earth-centred Earth-fixed (ECEF) and the site's own frame.
// Geodesy and gravity are GeographicLib's; nothing here allocates once the first call was made.
#pragma once

#include "fusion/site.h"

#include <Eigen/Geometry>

namespace locus {

struct Geodetic {
    double latitude_deg = 0;
    double longitude_deg = 0;
    double height_ellipsoid_m = 0;
};

inline constexpr double light_mps = 299792458;
inline constexpr double earth_rate_radps = 7.2921151467e-5; ///< IS-GPS-200

Eigen::Vector3d ecef_m(const Geodetic& at) noexcept;
Geodetic geodetic(const Eigen::Vector3d& position_ecef_m) noexcept;

/// East, north, up -> ECEF. Columns: east, north and up at the place.
Eigen::Matrix3d enu_to_ecef(const Geodetic& at) noexcept;

/// Gravity as a body at rest on the turning Earth feels it (centrifugal part included), WGS-84 normal gravity.
Eigen::Vector3d gravity_ecef_mps2(const Eigen::Vector3d& position_ecef_m) noexcept;

/// Site <-> ECEF: a plane that touches the ellipsoid at the site's origin; x axis at the given heading.
class SiteOnEarth {
  public:
    explicit SiteOnEarth(const Wgs84Anchor& origin) noexcept;

    Eigen::Vector3d ecef_m(const Eigen::Vector3d& position_site_m) const noexcept {
        return origin_ecef_m_ + to_ecef_ * position_site_m;
    }
    Eigen::Vector3d site_m(const Eigen::Vector3d& position_ecef_m) const noexcept {
        return to_ecef_.transpose() * (position_ecef_m - origin_ecef_m_);
    }
    /// Turns directions, velocities and covariances.
    const Eigen::Matrix3d& to_ecef() const noexcept { return to_ecef_; }

  private:
    Eigen::Vector3d origin_ecef_m_;
    Eigen::Matrix3d to_ecef_;
};

} // namespace locus
