// Which features of two pictures look alike, where nothing is known yet of how the camera moved: FLANN with locality-
// sensitive hashing, as paper 001 section 2.2 has it (Muja and Lowe 2012, "Fast matching of binary features").
#pragma once

#include "drivers/camera/odometry/features.h"

#include <span>
#include <utility>

namespace locus::camera {

/// Index in the first, index in the second.
using FeatureMatch = std::pair<std::size_t, std::size_t>;

/// Pairs whose first has no second choice nearly as like (ratio test, Lowe 2004, section 7.1), each feature at most
/// once.
std::vector<FeatureMatch> match_features(std::span<const Descriptor> first, std::span<const Descriptor> second);

std::vector<Descriptor> descriptors_of(const Features& features);

} // namespace locus::camera
