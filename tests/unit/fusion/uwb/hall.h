// Halls that the solvers are tried in, and observations made in them. Geometries of shared/bench/crlb.py.
#pragma once

#include "fusion/geometry/vector.h"
#include "fusion/uwb/range_model.h"
#include "fusion/uwb/solve.h"

#include <Eigen/Dense>

#include <random>
#include <utility>
#include <vector>

namespace locus::uwb::test {

using Eigen::Vector3d;
using Anchors = std::vector<Vector3d>;

inline const Anchors rectangle{{0, 0, 0}, {10, 0, 0}, {10, 8, 0}, {0, 8, 0}};
inline const Anchors rectangle_of_8{{0, 0, 0}, {10, 0, 0}, {10, 8, 0}, {0, 8, 0},
                                    {5, 0, 0}, {5, 8, 0},  {0, 4, 0},  {10, 4, 0}};
inline const Anchors ceiling{{0, 0, 2.8}, {10, 0, 2.8}, {10, 8, 2.8}, {0, 8, 2.8}};
inline const Anchors zigzag_of_6{{0, 0, 0.2}, {10, 0, 2.8}, {10, 8, 0.2}, {0, 8, 2.8}, {5, 0, 2.8}, {5, 8, 0.2}};
inline const Anchors box{{0, 0, 0.2}, {10, 0, 2.8}, {10, 8, 0.2}, {0, 8, 2.8},
                         {0, 0, 2.8}, {10, 0, 0.2}, {10, 8, 2.8}, {0, 8, 0.2}};

inline Vec3 array(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

inline std::vector<RangeTo> ranges_from(const Vector3d& tag, const Anchors& anchors) {
    std::vector<RangeTo> ranges;
    for (const Vector3d& anchor : anchors) ranges.push_back({array(anchor), range(tag, anchor), 0.1});
    return ranges;
}

/// Pairs as indices into the anchors.
using Pairs = std::vector<std::pair<int, int>>;

inline Pairs against_first(const Anchors& anchors) {
    Pairs pairs;
    for (int i = 1; i < static_cast<int>(anchors.size()); ++i) pairs.emplace_back(0, i);
    return pairs;
}

/// Each against its neighbour, the last against the first: what a TDOA2 Crazyflie hears.
inline Pairs round_robin(const Anchors& anchors) {
    const int count = static_cast<int>(anchors.size());
    Pairs pairs;
    for (int i = 0; i < count; ++i) pairs.emplace_back(i, (i + 1) % count);
    return pairs;
}

inline std::vector<DifferenceOf> differences_from(const Vector3d& tag, const Anchors& anchors, const Pairs& pairs) {
    std::vector<DifferenceOf> differences;
    for (const auto& [a, b] : pairs)
        differences.push_back(
            {array(anchors[a]), array(anchors[b]), range_difference(tag, anchors[a], anchors[b]), 0.1});
    return differences;
}

/// Uniform in the middle `share` of the anchors' bounding box.
inline Vector3d inside(const Anchors& anchors, std::mt19937_64& random, double share = 0.8) {
    Vector3d low = anchors[0], high = anchors[0];
    for (const Vector3d& anchor : anchors) {
        low = low.cwiseMin(anchor);
        high = high.cwiseMax(anchor);
    }
    std::uniform_real_distribution<double> unit(0.5 * (1 - share), 0.5 * (1 + share));
    Vector3d point;
    for (int axis = 0; axis < 3; ++axis) point(axis) = low(axis) + (high(axis) - low(axis)) * unit(random);
    return point;
}

} // namespace locus::uwb::test
