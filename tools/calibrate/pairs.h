// Distances between anchors out of a file: lines "a,b,range_m[,sigma_m]", or a recording in which anchors range each
// other.
#pragma once

#include "config/settings.h"
#include "fusion/site.h"
#include "fusion/uwb/survey/network.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace locus::calibrate {

struct MeasuredPairs {
    std::vector<Anchor> anchors; ///< those that were measured, in the order of the settings, else of their address
    std::vector<uwb::survey::PairRange> pairs; ///< by index in `anchors`: the median of each pair's ranges
    std::vector<std::size_t> counts;           ///< ranges of each pair
    std::vector<std::string> notes;            ///< what was left out, and why: sentences
};

/// `settings` may be missing: then anchors are known by their address alone. A pair that says no sigma of its own has
/// `sigma_m`. Throws std::runtime_error with a sentence when the file cannot be read or used.
MeasuredPairs read_pairs(const std::string& path, const std::optional<Settings>& settings, double sigma_m);

} // namespace locus::calibrate
