// Obstacles in the way of the radio.
#pragma once

#include "tests/papers/walk.h"

#include <algorithm>

namespace locus::papers {

/// Obstacles stand as posts along the way; a path to a station that crosses one is longer by what a blocked path is.
inline Blocked posts(const Way& places) {
    constexpr double radius_m = 0.25;
    return [places](const Eigen::Vector3d& tag_m, const Eigen::Vector3d& anchor_m, double) {
        double longer_m = 0;
        for (const Eigen::Vector2d& place : places) {
            const Eigen::Vector2d path = (anchor_m - tag_m).head<2>(), to_post = place - tag_m.head<2>();
            const double share = std::clamp(to_post.dot(path) / path.squaredNorm(), 0.0, 1.0);
            if ((to_post - share * path).norm() < radius_m) longer_m += blocked_longer_m;
        }
        return longer_m;
    };
}

} // namespace locus::papers
