// A range or a range difference in the one form that filters take: distance to one anchor, less distance to another if
// there is one. Anchors are named by their index in the site.
#pragma once

#include "fusion/geometry/vector.h"
#include "fusion/site.h"
#include "fusion/uwb/range_model.h"

#include <Eigen/Core>

#include <cstdint>

namespace locus::uwb {

struct Sighting {
    static constexpr std::int16_t nobody = -1;
    std::int16_t plus = nobody;  ///< anchor of a range, anchor_b of a difference
    std::int16_t minus = nobody; ///< anchor_a of a difference; nobody: a range
    float sigma_m = 0.1f;        ///< of the noise that is new each time
    double value_m = 0;          ///< free of the anchors' calibrated bias

    bool is_range() const { return minus == nobody; }
};

inline Eigen::Vector3d anchor_site_m(const Site& site, std::int16_t index) {
    return vector(site.anchors[static_cast<std::size_t>(index)].position_site_m);
}

inline double predicted_m(const Sighting& s, const Site& site, const Eigen::Vector3d& position_site_m) {
    const double plus_m = range(position_site_m, anchor_site_m(site, s.plus));
    return s.is_range() ? plus_m : plus_m - range(position_site_m, anchor_site_m(site, s.minus));
}

/// Of predicted_m() by position.
inline Eigen::Vector3d gradient(const Sighting& s, const Site& site, const Eigen::Vector3d& position_site_m) {
    Eigen::Vector3d plus = range_gradient(position_site_m, anchor_site_m(site, s.plus));
    if (s.is_range()) return plus;
    return plus - range_gradient(position_site_m, anchor_site_m(site, s.minus));
}

} // namespace locus::uwb
