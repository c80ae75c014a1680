// The transformation that lays an estimate on the truth best, for estimates in a frame of their own.
#pragma once

#include "tools/evaluate/associate.h"

#include <Eigen/Core>

#include <span>

namespace locus::evaluate {

enum class Alignment {
    none,
    yaw,  ///< turn about z and shift
    se3,  ///< any turn and shift
    sim3, ///< any turn, shift and one scale
};

struct Similarity {
    double scale = 1;
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();

    Eigen::Vector3d operator()(const Eigen::Vector3d& point_m) const {
        return scale * (rotation * point_m) + translation_m;
    }
};

/// Least sum of squared distances between truth and transformed estimate: Umeyama, IEEE PAMI 13 (1991), eq. 40-43;
/// about z alone the same sum has the closed form of a plane rotation. Throws std::invalid_argument with a sentence
/// when the points do not fix the transformation (all at one place, or for se3 and sim3 on one line).
Similarity align(std::span<const Pair> pairs, Alignment alignment);

} // namespace locus::evaluate
