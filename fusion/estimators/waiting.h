// What becomes of a measurement, and of the pose, while there is no first position yet.
#pragma once

#include "fusion/aid_status.h"
#include "fusion/pose.h"

namespace locus {

struct Waiting {
    Missing missing;  ///< what stands between the target and a pose
    Exclusion reason; ///< of the measurement that still gave none
};

/// `solved`: what the solver said of the last window; none: there is a position, but not all agree on it.
constexpr Waiting waiting_after(Exclusion solved) {
    if (solved == Exclusion::none) return {Missing::agreement, Exclusion::waiting_for_start};
    return {solved == Exclusion::geometry_too_few ? Missing::anchors : Missing::geometry, solved};
}

} // namespace locus
