// `locus calibrate camera walk`: poses of a tag and images of the person who carries it in; the camera's view of the
// floor and the offset of its clock out.
#pragma once

#include "tools/calibrate/camera_file.h"

#include <optional>
#include <string>

namespace locus::calibrate {

struct CameraWalkRequest {
    std::string poses;
    std::string target;            ///< name; empty: the only one there is
    std::string frames;            ///< video, folder of images, or device
    std::string lens;              ///< YAML with intrinsics; empty: a homography
    std::optional<double> start_s; ///< of a recording's first frame, in the poses' clock
    double search_s = 2;           ///< to either side, where start_s is given or frames are live
    double rate_hz = 0;            ///< of a recording; 0: what it says
    double seconds = 120;          ///< of a device
    std::string size;              ///< of a device; WIDTHxHEIGHT
    std::string detector = "motion";
    std::string detector_settings; ///< YAML file
    double pose_sigma_m = 0.2;     ///< horizontal error of this project on recorded walks (docs/accuracy.md)
};

/// Throws std::runtime_error where files cannot be used, CannotTell where they do not tell the view.
CameraReport calibrate_walk(const CameraWalkRequest& request);

} // namespace locus::calibrate
