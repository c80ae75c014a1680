// From a covariance to the one number that people ask for: within how many metres is it, 95 times of 100?
#pragma once

#include "fusion/pose.h"

#include <algorithm>
#include <cmath>

namespace locus {

/// Half-width that holds 95 % of a normal distribution of variance `zz`, m.
inline float vertical_error_95_m(double zz_m2) {
    return static_cast<float>(1.959964 * std::sqrt(std::max(zz_m2, 0.0)));
}

/// Radius of the circle round the estimate that holds the true point with 95 % probability, for a normal error of
/// covariance (xx, xy; xy, yy) in m^2. The radius over the ellipse's longer half axis is a function of the axis ratio
/// alone, from 1.960 (a line) to 2.448 (a circle); the cubic was fitted to numerical integration, within 0.3 %.
inline float horizontal_error_95_m(double xx_m2, double xy_m2, double yy_m2) {
    const double mean = 0.5 * (xx_m2 + yy_m2);
    const double spread = std::hypot(0.5 * (xx_m2 - yy_m2), xy_m2);
    const double longer_m = std::sqrt(std::max(mean + spread, 0.0));
    const double shorter_m = std::sqrt(std::max(mean - spread, 0.0));
    const double ratio = longer_m == 0 ? 0 : shorter_m / longer_m;
    const double factor = 1.9604 + ratio * (0.0142 + ratio * (0.0789 + ratio * 0.4010));
    return static_cast<float>(factor * longer_m);
}

/// Both of a pose, from its covariance.
inline void bound(Pose& pose) {
    const auto& p = pose.estimate.covariance;
    pose.horizontal_error_95_m = horizontal_error_95_m(p[0], p[1], p[7]);
    pose.vertical_error_95_m = vertical_error_95_m(p[14]);
}

} // namespace locus
