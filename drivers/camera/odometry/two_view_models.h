// The two models of a start, each with the motions that it allows and how well it explains the matches.
#pragma once

#include "drivers/camera/odometry/camera_pose.h"

#include <opencv2/core.hpp>

#include <vector>

namespace locus::camera {

struct TwoViewModel {
    double score = 0;                ///< Mur-Artal 2015, eq. 2
    std::vector<CameraPose> motions; ///< second from first, of length one; one of them is the true one
};

/// Points are slopes, x / z and y / z; `sigma` is that of a slope.
TwoViewModel essential_model(const std::vector<cv::Point2d>& first, const std::vector<cv::Point2d>& second,
                             double sigma);
TwoViewModel homography_model(const std::vector<cv::Point2d>& first, const std::vector<cv::Point2d>& second,
                              double sigma);

} // namespace locus::camera
