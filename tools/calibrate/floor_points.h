// `locus calibrate camera points`: pixels and places of the floor in, the camera's view of it out.
#pragma once

#include "tools/calibrate/camera_file.h"

#include <string>

namespace locus::calibrate {

struct PointsRequest {
    std::string file;
    std::string lens;      ///< YAML with intrinsics; empty: a homography
    std::string size;      ///< WIDTHxHEIGHT; empty: that of `lens`
    double sigma_px = 2;   ///< a mark of the floor that somebody clicks on
    double sigma_m = 0.02; ///< a tape over a floor
};

/// Throws std::runtime_error where files cannot be used, CannotTell where they do not tell the view.
CameraReport calibrate_points(const PointsRequest& request);

} // namespace locus::calibrate
