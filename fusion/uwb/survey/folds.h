// Anchors that a descent left in a wrong place: each in turn is put where its pairs would have it on the other side of
// the plane (or line) of those it measured, or where they would have it without one of them, which may be the blocked
// one; it stays there if that fits better.
#pragma once

#include "fusion/uwb/survey/network.h"

#include <vector>

namespace locus::uwb::survey {

/// The best of the minima that are reached by moving one anchor after the other.
Descent unfolded(const std::vector<PairRange>& pairs, const Sought& sought, const Positions& start_m, int dimensions);

/// One anchor folded over and everything adjusted again; the same positions where there is nothing to fold over.
Descent folded(const std::vector<PairRange>& pairs, const Sought& sought, const Positions& at_m, std::size_t station,
               int dimensions);

} // namespace locus::uwb::survey
