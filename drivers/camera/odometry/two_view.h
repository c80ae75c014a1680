// How a camera moved between two pictures, from nothing but matched features: the start of a map. A scene that is flat,
// or hardly moved past, is told by a homography, any other by an essential matrix; both are fitted, and the one that
// explains more is taken (Mur-Artal 2015, "ORB-SLAM: a versatile and accurate monocular SLAM system", section IV).
#pragma once

#include "drivers/camera/odometry/camera_pose.h"
#include "drivers/camera/odometry/feature_matches.h"

#include <optional>
#include <vector>

namespace locus::camera {

struct TwoView {
    CameraPose second_from_first;                                 ///< the way is of length one
    bool is_flat = false;                                         ///< told by the homography
    std::vector<std::pair<FeatureMatch, Eigen::Vector3d>> points; ///< in the first camera's axes
};

/// Empty while it cannot be told: too few points, too small a parallax, or two motions that explain it alike.
std::optional<TwoView> find_two_view(const Features& first, const Features& second,
                                     const std::vector<FeatureMatch>& matches, double focal_px);

} // namespace locus::camera
