// A place of the floor and the pixel that shows it: what cameras are surveyed from. The site's z is 0 on the floor;
// pixel axes are those of fusion/vision (from the corner of the upper left pixel).
#pragma once

#include <Eigen/Core>

namespace locus::vision::survey {

struct FloorPair {
    Eigen::Vector2d pixel_px{0, 0};
    Eigen::Vector2d site_m{0, 0};
    double sigma_px = 1; ///< of the pixel, along each axis
    double sigma_m = 0;  ///< of the place, along each axis
};

} // namespace locus::vision::survey
