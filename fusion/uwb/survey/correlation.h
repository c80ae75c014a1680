// How many of a series' values count as one: errors of ranges stay the same for seconds (multipath, bodies), so that a
// thousand of them say far less of their mean than a thousand independent ones.
#pragma once

#include <vector>

namespace locus::uwb::survey {

/// Integrated autocorrelation time in samples, 1 or more: 1 + 2 sum of the autocorrelations, summed in pairs up to the
/// first pair that is not positive (Geyer 1992, initial positive sequence).
double correlated_samples(const std::vector<double>& series);

} // namespace locus::uwb::survey
