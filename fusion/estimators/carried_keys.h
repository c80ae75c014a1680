// What the errors that a filter carries along are called (filter/wandering_state.h): one name for each, in one place.
#pragma once

#include "fusion/measurement.h"

namespace locus::carried {

/// Of what all ranges of a tag have in common; of a height sensor; of the height at which a tag is worn.
inline constexpr std::int32_t common_range = -1, height = -2, worn_height = -3;

constexpr std::int32_t passing(std::int16_t anchor) { return anchor; }
constexpr std::int32_t offset(std::int16_t anchor) { return 0x10000 + anchor; }

/// `axis` 0 or 1. From the 1025th camera on two share their errors.
constexpr std::int32_t feet(Address camera, int axis) {
    return 0x20000 + 2 * static_cast<std::int32_t>(number(camera) % 1024) + axis;
}

/// Of a SLAM's path as it was aligned with the site; `alignment` counts how often it was aligned anew.
constexpr std::int32_t odometry(std::uint32_t alignment, int axis) {
    return 0x40000 + 3 * static_cast<std::int32_t>(alignment % 1024) + axis;
}

} // namespace locus::carried
