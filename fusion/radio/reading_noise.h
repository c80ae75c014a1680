// How likely a strength is where another was expected: a bell for what the map does not tell; beside it a tail towards
// weaker, for bodies between the radios, which take decibels and never give any (Januszkiewicz, Sensors 2018, 18,
// 3412); under both a floor for what fits nothing.
#pragma once

#include "fusion/filter/lanes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace locus::radio {

struct ReadingNoise {
    float body_share = 0.2F;     ///< of readings that came past a body which was not there in the survey
    float body_loss_db = 8;      ///< mean of what it takes, exponentially distributed: several bodies add up
    float outlier_share = 0.05F; ///< of readings that fit nothing
};

/// Of single fingerprints in a place that is as it was surveyed.
inline constexpr ReadingNoise as_surveyed{0, 8, 0};

/// What a reading that fits nothing is spread over: all that a radio hears.
inline constexpr float outlier_range_db = 80;

/// Of a bell less an exponential loss: the exponentially modified normal distribution, mirrored, with the logistic
/// curve in place of the normal integral (within 0.01 of it; Bowling et al. 2009), which holds for bells up to one and
/// a half losses wide.
inline float shadowed_density(float off_db, float sigma_db, float loss_db) noexcept {
    constexpr float logistic = 1.702F;
    const float ratio = std::min(sigma_db / loss_db, 1.5F);
    const float steps = logistic * (off_db / sigma_db + ratio); // never so small that the exponent below is positive
    const float exponent = off_db / loss_db + 0.5F * ratio * ratio - std::max(0.0F, steps);
    return filter::exp_of_negative(std::min(0.0F, exponent)) / (1 + filter::exp_of_negative(-std::abs(steps))) /
           loss_db;
}

/// Natural logarithm of the density, 1/dB, of a reading `off_db` stronger than was expected with that variance.
inline float log_likelihood(float off_db, float variance_db2, const ReadingNoise& noise) noexcept {
    const float sigma_db = std::sqrt(variance_db2), z = off_db / sigma_db;
    const float bell =
        std::exp(-0.5F * z * z) * 0.5F * std::numbers::inv_sqrtpi_v<float> * std::numbers::sqrt2_v<float> / sigma_db;
    const float fits =
        (1 - noise.body_share) * bell + noise.body_share * shadowed_density(off_db, sigma_db, noise.body_loss_db);
    return std::log((1 - noise.outlier_share) * fits + noise.outlier_share / outlier_range_db);
}

} // namespace locus::radio
