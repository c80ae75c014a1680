// Frames in, people's feet in pixels out: the detector and the tracker of the daemon, one after the other.
#pragma once

#include "fusion/vision/survey/walk_start.h"
#include "tools/calibrate/camera_walk.h"

#include <cstddef>
#include <vector>

namespace locus::calibrate {

struct SeenFeet {
    std::vector<vision::survey::SeenFoot> feet;
    Eigen::Vector2d image_px{0, 0};
    std::size_t frames = 0;
    double first_s = 0, last_s = 0; ///< of the frames
};

bool is_device(const std::string& frames);

/// A recording's first frame is at `start_s`. Throws std::runtime_error with a sentence.
SeenFeet see_feet(const CameraWalkRequest& request, double start_s);

} // namespace locus::calibrate
