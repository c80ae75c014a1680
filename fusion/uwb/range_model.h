// What a range and a range difference say of a position: prediction and gradient. The solvers and every filter that
// takes UWB use these, so that one sign and one guard hold for all.
#pragma once

#include <Eigen/Core>

#include <algorithm>

namespace locus::uwb {

/// Below this distance from an anchor the direction to it means nothing.
inline constexpr double on_anchor_m = 1e-6;

/// A range and its gradient by position, which share one square root.
struct Sight {
    Eigen::Vector3d gradient; ///< unit vector from the anchor to the position; falls to zero on the anchor
    double range_m = 0;
};

inline Sight sight_of(const Eigen::Vector3d& position_m, const Eigen::Vector3d& anchor_m) {
    const Eigen::Vector3d from_anchor_m = position_m - anchor_m;
    const double range_m = from_anchor_m.norm();
    return {from_anchor_m * (1 / std::max(range_m, on_anchor_m)), range_m};
}

/// Distance from position to anchor, m (same frame).
inline double range(const Eigen::Vector3d& position_m, const Eigen::Vector3d& anchor_m) {
    return sight_of(position_m, anchor_m).range_m;
}

/// Gradient of range() by position. On the anchor itself, where it does not exist, it is zero: such a range moves
/// nothing.
inline Eigen::Vector3d range_gradient(const Eigen::Vector3d& position_m, const Eigen::Vector3d& anchor_m) {
    return sight_of(position_m, anchor_m).gradient;
}

/// distance(position, b) - distance(position, a), m: paper 000 eq. 1 with a as the master station.
inline double range_difference(const Eigen::Vector3d& position_m, const Eigen::Vector3d& anchor_a_m,
                               const Eigen::Vector3d& anchor_b_m) {
    return range(position_m, anchor_b_m) - range(position_m, anchor_a_m);
}

/// Gradient of range_difference() by position: a row of G1 in paper 000 eq. 10.
inline Eigen::Vector3d range_difference_gradient(const Eigen::Vector3d& position_m, const Eigen::Vector3d& anchor_a_m,
                                                 const Eigen::Vector3d& anchor_b_m) {
    return range_gradient(position_m, anchor_b_m) - range_gradient(position_m, anchor_a_m);
}

} // namespace locus::uwb
