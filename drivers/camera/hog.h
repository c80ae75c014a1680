// Histograms of oriented gradients with OpenCV's own people detector (Dalal and Triggs 2005, "Histograms of oriented
// gradients for human detection"). For .cpp files of this room only.
#pragma once

#include "fusion/vision/detection.h"

#include <opencv2/objdetect.hpp>

#include <cstddef>
#include <functional>
#include <vector>

namespace locus::camera {

/// Smallest: half of what the detector was taught with, so that the picture is doubled. Margin and overlap: windows of
/// a plainly positive margin; the boxes of two people overlap by less than half.
struct HogSettings {
    double least_outline_px = 48;
    double least_margin = 0.3;
    double scale_step = 1.05;
    double most_iou = 0.45;
};

class Hog {
  public:
    /// Whether it is worth looking for a person in that box, which is looked for in pictures of size number `level`.
    using Wanted = std::function<bool(std::size_t level, const vision::BoxPx& person)>;

    explicit Hog(const HogSettings& settings);

    /// Every window that holds a person at least `least_outline_px` high, several for each, where one is wanted and
    /// close by. The score is the margin of the support vector machine.
    std::vector<vision::Detection> find(const cv::Mat& picture, const Wanted& wanted) const;

  private:
    /// By which a picture is enlarged for that size of outlines, the smallest first.
    double factor_of(std::size_t level) const;
    void find_in_patch(const cv::Mat& level, const cv::Rect& cells, double factor,
                       std::vector<vision::Detection>& people) const;

    HogSettings settings_;
    cv::HOGDescriptor descriptor_;
};

} // namespace locus::camera
