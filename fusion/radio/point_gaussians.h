// A normal distribution of strengths at every reference point, and nothing between them: the probabilistic map of
// Youssef and Agrawala (2005). One spread for all points and beacons, found from the map: with the readings of a single
// device at a single time, a point's own spread says nothing of the next visit.
#pragma once

#include "fusion/radio/radio_map.h"

#include <Eigen/Core>

#include <optional>
#include <span>

namespace locus::radio {

/// The spread under which each point is best foretold by the others (leave-one-out likelihood), dB.
double point_spread_db(const RadioMap& map, double floor_dbm);

/// Mean over the points' probabilities, m on the floor. Beacons that one side did not hear count at `floor_dbm`. Empty
/// when the map has no points.
std::optional<Eigen::Vector2d> locate_by_points(const RadioMap& map, std::span<const Reading> fingerprint,
                                                double spread_db, double floor_dbm);

} // namespace locus::radio
