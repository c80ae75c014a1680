// The site: where the anchors stand and the walls. Site frame: right-handed, metres, z up.
#pragma once

#include "fusion/measurement.h"
#include "fusion/option.h"

#include <array>
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
    double antenna_delay_m = 0; ///< of sending and receiving together, beyond what is programmed; where it sends sync
};

inline constexpr std::array anchor_options{
    required_option<&Anchor::name>("name", "Name that people see."),
    required_option<&Anchor::address>("address", "The number the anchor calls itself by: 3, 0x1234, DE:CA:... (EUI)."),
    option<&Anchor::position_site_m>("position_site_m", "m", -1e5, 1e5, "Where its antenna is: [x, y, z], z up.", {},
                                     true),
    option<&Anchor::range_bias_m>("range_bias_m", "m", -100, 100,
                                  "Measured range less true range, from a calibration."),
    option<&Anchor::sigma_m>("sigma_m", "m", 0.001, 100,
                             "Standard deviation of one range; left out: the estimator's setting."),
    option<&Anchor::antenna_delay_m>(
        "antenna_delay_m", "m", -1000, 1000,
        "Of an anchor that sends sync packets: what its radio adds to sending and receiving "
        "together, beyond what is programmed in the chip."),
};

/// Where the site's origin lies on the Earth, for GNSS; heading is of the site's x axis, clockwise from north.
struct Wgs84Anchor {
    double latitude_deg = 0;
    double longitude_deg = 0;
    double height_ellipsoid_m = 0;
    double x_axis_heading_deg = 90;
};

inline constexpr std::array origin_options{
    option<&Wgs84Anchor::latitude_deg>("latitude_deg", "deg", -90, 90, "Latitude of the site's origin, WGS-84.", {},
                                       true),
    option<&Wgs84Anchor::longitude_deg>("longitude_deg", "deg", -180, 180, "Longitude of the site's origin, WGS-84.",
                                        {}, true),
    option<&Wgs84Anchor::height_ellipsoid_m>("height_ellipsoid_m", "m", -1000, 20000,
                                             "Height of the site's origin above the WGS-84 ellipsoid."),
    option<&Wgs84Anchor::x_axis_heading_deg>("x_axis_heading_deg", "deg", -360, 360,
                                             "Direction of the site's x axis, clockwise from true north."),
};

/// A wall of the floor plan, as people meet it: from one end to the other, seen from above.
struct Wall {
    Vec3 from_site_m{};
    Vec3 to_site_m{};
};

inline constexpr std::array wall_options{
    option<&Wall::from_site_m>("from_site_m", "m", -1e5, 1e5, "One end: [x, y, z]; z does not matter yet.", {}, true),
    option<&Wall::to_site_m>("to_site_m", "m", -1e5, 1e5, "The other end: [x, y, z].", {}, true),
};

struct Site {
    std::string name;
    std::vector<Anchor> anchors;
    std::vector<Wall> walls;
    std::optional<Wgs84Anchor> origin;

    /// nullptr when the address is not an anchor of the site. Linear: sites have tens of anchors.
    const Anchor* find_anchor(Address address) const noexcept {
        for (const Anchor& anchor : anchors)
            if (anchor.address == address) return &anchor;
        return nullptr;
    }
};

inline constexpr std::array site_options{option<&Site::name>("name", "Name of the site.")};

} // namespace locus
