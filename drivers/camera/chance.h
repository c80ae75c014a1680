// Scores that mean the same whatever found somebody: the tracker's thresholds are chances from 0 to 1.
#pragma once

#include <cmath>

namespace locus::camera {

/// Of a support vector machine's margin: Platt's sigmoid ("Probabilistic outputs for support vector machines", 1999,
/// eq. 1) with the slope of a logistic regression, fitted to no recording. A margin of 1, where its own examples lie,
/// is 0.73.
inline float chance_of_margin(float margin) { return 1 / (1 + std::exp(-margin)); }

/// Of what fills its box with movement: the share says nothing more, for it is largest where people walk in groups and
/// their boxes are wrong (docs/cameras-detectors.md).
inline constexpr float chance_of_movement = 1;

} // namespace locus::camera
