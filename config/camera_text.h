// A camera's calibration as the YAML that config/camera_calibration.h reads back to the same numbers.
#pragma once

#include "config/camera_calibration.h"

#include <string>
#include <vector>

namespace locus::config {

/// Each remark is a line of comment at the top. Empty for a Tsai lens: only its XML has words for it.
std::string camera_yaml(const CameraCalibration& calibration, const std::vector<std::string>& remarks = {});
std::string lens_yaml(const LensCalibration& calibration, const std::vector<std::string>& remarks = {});

} // namespace locus::config
