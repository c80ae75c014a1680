// Rectangles that hold all marked cells of a grid, few and small. For .cpp files of this room only.
#pragma once

#include <opencv2/core.hpp>

#include <vector>

namespace locus::camera {

/// Marks that stand closer than a window of the outline detector is wide share a rectangle: what neighbours have in
/// common is computed once. Rectangles may overlap.
std::vector<cv::Rect> patches_of(const cv::Mat1b& marked);

} // namespace locus::camera
