// The site: where the anchors stand. Site frame: right-handed, metres, z up.
#pragma once

#include "fusion/measurement.h"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace locus {

struct Anchor {
    std::string name;
    Address address = no_address;
    Vec3 position_site_m{};
    double range_bias_m = 0;       ///< measured range less true range, from a calibration
    double sigma_m = std::nan(""); ///< of one range; NaN: the estimator's setting
};

/// Where the site's origin lies on the Earth, for GNSS; heading is of the site's x axis, clockwise from north.
struct Wgs84Anchor {
    double latitude_deg = 0;
    double longitude_deg = 0;
    double height_ellipsoid_m = 0;
    double x_axis_heading_deg = 90;
};

struct Site {
    std::string name;
    std::vector<Anchor> anchors;
    std::optional<Wgs84Anchor> origin;

    /// nullptr when the address is not an anchor of the site. Linear: sites have tens of anchors.
    const Anchor* find_anchor(Address address) const noexcept {
        for (const Anchor& anchor : anchors)
            if (anchor.address == address) return &anchor;
        return nullptr;
    }
};

} // namespace locus
