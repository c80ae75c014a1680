// Surveyed places of a floor and the pixels that show them, out of a file.
#pragma once

#include "fusion/vision/survey/floor_pair.h"

#include <string>
#include <vector>

namespace locus::calibrate {

struct FloorPoints {
    std::vector<vision::survey::FloorPair> pairs;
    std::vector<std::string> names; ///< as in the file, else the line's number
};

/// Lines "x_px,y_px,x_m,y_m" or "x_px,y_px,x_m,y_m,name"; '#' begins a remark, a first line of column names is passed
/// over. Pixels are counted from the middle of the upper left one, as image viewers do. Throws std::runtime_error.
FloorPoints read_points(const std::string& path, double sigma_px, double sigma_m);

} // namespace locus::calibrate
