// How far an odometry's path is from the truth, once origin, rotation and scale of its frame are taken out.
#pragma once

#include <Eigen/Geometry>

#include <vector>

namespace locus::room {

struct PathPair {
    Eigen::Vector3d truth_m, told;
    Eigen::Quaterniond truth_turn, told_turn; ///< camera's axes in the frame
};

struct OdometryScore {
    double length_m = 0; ///< of the true way
    double rmse_m = 0;   ///< after one similarity for the whole path (Umeyama 1991)
    double relative = 0; ///< mean error of all ways of a given length, as a share of it, with that one scale
    double metres_a_unit = 0;
};

/// `way_m`: length of the ways that `relative` is about (as KITTI's odometry benchmark, Geiger 2012, has it).
OdometryScore score_odometry(const std::vector<PathPair>& path, double way_m);

} // namespace locus::room
