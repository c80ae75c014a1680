// The rows of the detectors' table, one a file.
#pragma once

#include "drivers/camera/detector.h"

namespace locus::camera {

DetectorRow motion_row();
DetectorRow hog_row();
DetectorRow hog_motion_row();
DetectorRow network_row();

} // namespace locus::camera
