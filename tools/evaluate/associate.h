// Which truth belongs to which estimate: the truth interpolated at the time of each estimate.
#pragma once

#include "tools/evaluate/track.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace locus::evaluate {

struct Selection {
    double max_gap_s = 0.25; ///< two points of the truth further apart are not interpolated between
    double from_s = -std::numeric_limits<double>::infinity();
    double to_s = std::numeric_limits<double>::infinity();
    double min_truth_z_m = -std::numeric_limits<double>::infinity(); ///< lower is not scored: on the ground
};

struct Pair {
    double time_s = 0;
    Eigen::Vector3d truth_m;
    Eigen::Vector3d estimate_m;
    double horizontal_bound_m = no_bound;
    double vertical_bound_m = no_bound;
};

struct Association {
    std::vector<Pair> pairs;
    std::size_t outside_truth = 0; ///< before the truth's first or after its last point
    std::size_t in_gap = 0;        ///< where the truth has a gap
    std::size_t not_selected = 0;  ///< left out by time or height
};

/// Truth positions linear between neighbours. Both tracks in order of time.
Association associate(const Track& truth, const Track& estimate, const Selection& selection);

} // namespace locus::evaluate
