// Where something was over time, as truth or as estimate says.
#pragma once

#include <Eigen/Core>

#include <limits>
#include <vector>

namespace locus::evaluate {

inline constexpr double no_bound = std::numeric_limits<double>::quiet_NaN();

struct TrackPoint {
    double time_s = 0;
    Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
    double horizontal_bound_m = no_bound; ///< published 95 % bounds of the error, where the file has them
    double vertical_bound_m = no_bound;
};

/// Times strictly increase and everything but a bound is finite: the readers see to it.
using Track = std::vector<TrackPoint>;

} // namespace locus::evaluate
