// Robust weights: how much of its information an observation keeps when it lies far from what was predicted. A hard
// gate alone loses tracks in multipath (it refuses the truth once the filter is wrong); a soft weight lets go slowly.
#pragma once

#include <cmath>

namespace locus::filter {

/// Weight 0..1 of a residual given in standard deviations, for the Cauchy distribution of scale `scale`: what lies
/// far out counts next to nothing (Zhang 1997, "Parameter estimation techniques", table 1).
inline double cauchy_weight(double residual_in_sigma, double scale) {
    const double u = residual_in_sigma / scale;
    return 1 / (1 + u * u);
}

/// Weight 0..1 of a residual given in standard deviations, for Huber's function: Gaussian up to `scale`, then the pull
/// of an observation stays constant however far out it lies.
inline double huber_weight(double residual_in_sigma, double scale) {
    const double size = std::abs(residual_in_sigma);
    return size <= scale ? 1 : scale / size;
}

/// The measurement variance under which the innovation's whole variance becomes `innovation_variance / weight`.
/// The weight must lie in (0, 1]; so the result is never below `innovation_variance - state_variance`.
inline double weakened_variance(double innovation_variance, double state_variance, double weight) {
    return innovation_variance / weight - state_variance;
}

} // namespace locus::filter
