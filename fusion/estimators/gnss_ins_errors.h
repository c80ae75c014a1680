// What the observations of a vehicle's track share: the names of the errors that stay, and small pieces of algebra.
#pragma once

#include "fusion/estimators/gnss_ins_track.h"
#include "fusion/units.h"

#include <cmath>
#include <cstdint>

namespace locus {

/// Names of the wandering errors. Satellites are called by constellation and number, all else below zero.
inline constexpr std::int32_t wheel_scale_error = -1, mounting_yaw_error = -2, mounting_pitch_error = -3,
                              pressure_offset = -4, pressure_weather = -5, heading_mounting_error = -6,
                              heading_error = -7, fix_error = -10, constellation_clock = -20, held_place_state = -40,
                              sensor_scale_error = -50, anchor_error = -1000;

using GnssInsRow = GnssInsTrack::Vector;

inline GnssInsRow blank_row(const GnssInsTrack& track) { return GnssInsRow::Zero(track.size()); }

inline double stated_or(float sigma, double otherwise) {
    return std::isfinite(sigma) && sigma > 0 ? double{sigma} : otherwise;
}

inline double own_square(double x) { return x * x; }

} // namespace locus
