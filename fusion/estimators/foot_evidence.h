// What estimators ask of a foot point before they believe it.
#pragma once

#include "fusion/aid_status.h"
#include "fusion/measurement.h"

#include <Eigen/LU>

#include <cmath>

namespace locus {

/// Of the place on the floor, m^2, as the camera says it.
inline Eigen::Matrix2d covariance_of(const FootPoint& foot) noexcept {
    const auto [xx, xy, yy] = foot.covariance_m2;
    return Eigen::Matrix2d{{xx, xy}, {xy, yy}};
}

/// Whether its numbers can be a place and a covariance.
inline bool is_sound(const FootPoint& foot) noexcept {
    const auto [xx, xy, yy] = foot.covariance_m2;
    const bool is_finite = std::isfinite(foot.position_site_m[0]) && std::isfinite(foot.position_site_m[1]) &&
                           std::isfinite(xx) && std::isfinite(xy) && std::isfinite(yy);
    return is_finite && xx >= 0 && yy >= 0 && xx * yy >= xy * xy;
}

/// Of a distance on the floor whose covariance was expected; in sigma: of two coordinates together.
inline Verdict judge_on_floor(const Eigen::Vector2d& apart_m, const Eigen::Matrix2d& expected_m2,
                              double gate_in_sigma) noexcept {
    const double weighed = std::sqrt(apart_m.dot(expected_m2.inverse() * apart_m));
    const double distance_m = apart_m.norm();
    const double sigma_m = weighed > 0 ? distance_m / weighed : std::sqrt(0.5 * expected_m2.trace());
    return verdict_of(distance_m, sigma_m, gate_in_sigma);
}

} // namespace locus
