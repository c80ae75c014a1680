// Nearest neighbours in signal space (paper 003 section 2 after Bahl and Padmanabhan 2000): the reference points whose
// strengths are most alike, and the mean of where they are. The yardstick that everything else is measured against.
#pragma once

#include "fusion/radio/radio_map.h"

#include <Eigen/Core>

#include <optional>
#include <span>

namespace locus::radio {

struct NeighbourSettings {
    std::size_t count = 4;
    bool weighted = false; ///< by the reciprocal of the distance in signal space, in dB
};

/// Mean position, m, on the floor. A beacon that only one of both sides heard counts there as heard at `floor_dbm`.
/// Empty when the map has no points, or none of its beacons is in the fingerprint.
std::optional<Eigen::Vector2d> nearest_neighbours(const RadioMap& map, std::span<const Reading> fingerprint,
                                                  const NeighbourSettings& settings, double floor_dbm);

} // namespace locus::radio
