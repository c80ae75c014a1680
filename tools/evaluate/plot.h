// The picture of an evaluation: the track from above, its height over time, and how the errors are distributed.
#pragma once

#include "tools/evaluate/statistics.h"
#include "tools/evaluate/track.h"

#include <span>
#include <string>

namespace locus::evaluate {

/// A whole SVG file. At least one pair. `truth` is drawn over the time of the pairs.
std::string plot(const Track& truth, std::span<const Pair> pairs, const Similarity& similarity,
                 const std::string& title);

} // namespace locus::evaluate
