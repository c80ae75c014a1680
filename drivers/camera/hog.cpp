#include "drivers/camera/hog.h"

#include "drivers/camera/person_shape.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace locus::camera {
namespace {

/// In the window of 64 x 128 that the detector was taught with, a person is 96 px high: 16 px are left on all sides
/// (Dalal and Triggs 2005, section 3).
constexpr float window_height_px = 128;
constexpr float margin_px = 16;
constexpr float person_height_px = window_height_px - 2 * margin_px;

vision::BoxPx person_in(const cv::Rect& window, double factor) {
    const float scale = static_cast<float>(window.height) / window_height_px;
    const float middle_px = static_cast<float>(window.x) + 0.5F * static_cast<float>(window.width);
    const float foot_px = static_cast<float>(window.br().y) - margin_px * scale;
    const auto back = static_cast<float>(1 / factor);
    return standing_box(middle_px * back, foot_px * back, person_height_px * scale * back);
}

} // namespace

Hog::Hog(const HogSettings& settings) : settings_{settings} {
    descriptor_.setSVMDetector(cv::HOGDescriptor::getDefaultPeopleDetector());
}

std::vector<vision::Detection> Hog::find(const cv::Mat& picture) const {
    const double factor = person_height_px / settings_.least_outline_px;
    cv::Mat scaled;
    cv::resize(picture, scaled, {}, factor, factor, factor > 1 ? cv::INTER_LINEAR : cv::INTER_AREA);
    const auto edge = static_cast<int>(margin_px); // people at the border have their margin outside
    std::vector<cv::Rect> windows;
    std::vector<double> margins;
    if (scaled.cols + 2 * edge < 64 || scaled.rows + 2 * edge < 128) return {};
    descriptor_.detectMultiScale(scaled, windows, margins, settings_.least_margin, {8, 8}, {edge, edge},
                                 settings_.scale_step, 0);
    std::vector<vision::Detection> people;
    for (std::size_t i = 0; i < windows.size(); ++i)
        people.push_back({person_in(windows[i], factor), static_cast<float>(margins[i]), {}});
    return people;
}

} // namespace locus::camera
