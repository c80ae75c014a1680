// What moves, region by region. For .cpp files of this room only.
#pragma once

#include "fusion/vision/detection.h"

#include <opencv2/core.hpp>

#include <optional>
#include <vector>

namespace locus::camera {

/// Connected regions as they are, for as long as no height is known.
std::vector<vision::Detection> regions_as_people(const cv::Mat& foreground, float least_height_px);

/// Whether a region looks like one person who stands alone: solid, upright, whole inside the image.
bool is_lone_person(const vision::Detection& region, const cv::Size& image);

/// Where what moves ends near the lower end of a box; empty where nothing of it moves, or where it goes on below:
/// another person, or more of one than the box has.
std::optional<float> lowest_moving_px(const cv::Mat& foreground, const vision::BoxPx& box);

} // namespace locus::camera
