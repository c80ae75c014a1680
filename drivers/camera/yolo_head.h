// What networks of the YOLO family put out, decoded to boxes in pixels of their input. The heads differ in who stands
// where:
//  v3  Darknet's layers: rows of x, y, w, h in shares of the input, objectness, classes that hold it already
//  v5  rows of x, y, w, h in pixels, objectness, classes (also v6, v7)
//  v8  columns of x, y, w, h in pixels, classes; no objectness (also v9, v11)
// For .cpp files of this room only.
#pragma once

#include "fusion/vision/detection.h"

#include <opencv2/core.hpp>

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace locus::camera {

inline constexpr std::array<std::string_view, 4> yolo_head_names{"auto", "v3", "v5", "v8"};

struct YoloHead {
    std::string name = "auto"; ///< of yolo_head_names; auto: by the shape of what comes out
    int person_class = 0;
    double least_score = 0.25;
};

/// Adds what one output holds; a sentence that says what does not fit, empty when all is well.
std::string decode(const cv::Mat& output, const YoloHead& head, const cv::Size& input,
                   std::vector<vision::Detection>& people);

} // namespace locus::camera
