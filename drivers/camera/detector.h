// Finds people in pictures. One interface, several ways to do it, chosen by name in the settings; a new one is a file
// and a row of the table.
#pragma once

#include "drivers/camera/picture.h"
#include "fusion/option.h"
#include "fusion/vision/detection.h"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace locus::camera {

/// How high in the image a standing person is whose feet are at that pixel, px, from a calibration. NaN, zero or less:
/// nobody can stand there. An empty function: not calibrated.
using ExpectedHeight = std::function<float(float foot_x_px, float foot_y_px)>;

class Detector {
  public:
    virtual ~Detector() = default;
    /// People with their looks, the surest first. Pictures come in order of time; their size may change.
    virtual std::vector<vision::Detection> detect(const Picture& picture) = 0;
};

struct DetectorRow {
    std::string_view name;
    std::string_view about;
    OptionTable options;
    /// Empty, and a sentence in `error`, when a file that the settings name cannot be used.
    std::unique_ptr<Detector> (*make)(const void* settings, const ExpectedHeight& height, std::string& error);
};

std::span<const DetectorRow> detector_table();
const DetectorRow* find_detector(std::string_view name);

} // namespace locus::camera
