// Which hypotheses about a field a map makes likely. For .cpp files of this room only.
#pragma once

#include "fusion/radio/field_evidence.h"

#include <vector>

namespace locus::radio {

struct WeightedHypothesis {
    FieldHypothesis hypothesis;
    double weight = 0; ///< of all together 1
};

/// The likely ones; of a map with more points than are searched only the best, for there the others weigh nothing.
std::vector<WeightedHypothesis> likely(const FieldData& data, double spacing_m);

} // namespace locus::radio
