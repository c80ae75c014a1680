#include "drivers/camera/hog.h"

#include "drivers/camera/patches.h"
#include "drivers/camera/person_shape.h"

#include <opencv2/imgproc.hpp>

#include <cmath>

namespace locus::camera {
namespace {

/// In the window of 64 x 128 that the detector was taught with, a person is 96 px high: 16 px are left on all sides
/// (Dalal and Triggs 2005, section 3).
constexpr int window_width_px = 64;
constexpr int window_height_px = 128;
constexpr int margin_px = 16;
constexpr int person_height_px = window_height_px - 2 * margin_px;
constexpr int step_px = 8; // from one window to the next: a cell

cv::Size enlarged(const cv::Size& picture, double factor) {
    return {static_cast<int>(std::lround(picture.width * factor)),
            static_cast<int>(std::lround(picture.height * factor))};
}

/// How many windows a picture has room for; people at its border have their margin outside.
cv::Size windows_in(const cv::Size& level) {
    const int width_px = level.width + 2 * margin_px - window_width_px;
    const int height_px = level.height + 2 * margin_px - window_height_px;
    return width_px < 0 || height_px < 0 ? cv::Size{} : cv::Size{width_px / step_px + 1, height_px / step_px + 1};
}

/// Of the window in that column and row of cells, in the picture as it came.
vision::BoxPx person_in(int column, int row, double factor) {
    const int middle_px = column * step_px - margin_px + window_width_px / 2;
    const int foot_px = row * step_px - 2 * margin_px + window_height_px;
    return standing_box(static_cast<float>(middle_px / factor), static_cast<float>(foot_px / factor),
                        static_cast<float>(person_height_px / factor));
}

cv::Mat1b wanted_cells(const cv::Size& windows, const std::function<bool(int column, int row)>& wanted) {
    cv::Mat1b cells(windows);
    for (int row = 0; row < windows.height; ++row)
        for (int column = 0; column < windows.width; ++column) cells(row, column) = wanted(column, row) ? 255 : 0;
    return cells;
}

cv::Mat with_margin(const cv::Mat& picture, const cv::Size& size) {
    cv::Mat level;
    cv::resize(picture, level, size, 0, 0, size.width > picture.cols ? cv::INTER_LINEAR : cv::INTER_AREA);
    cv::copyMakeBorder(level, level, margin_px, margin_px, margin_px, margin_px, cv::BORDER_REFLECT_101);
    return level;
}

} // namespace

Hog::Hog(const HogSettings& settings) : settings_{settings} {
    descriptor_.setSVMDetector(cv::HOGDescriptor::getDefaultPeopleDetector());
}

double Hog::factor_of(std::size_t level) const {
    return person_height_px / settings_.least_outline_px * std::pow(settings_.scale_step, -static_cast<double>(level));
}

std::vector<vision::Detection> Hog::find(const cv::Mat& picture, const Wanted& wanted) const {
    std::vector<vision::Detection> people;
    for (std::size_t number = 0;; ++number) {
        const double factor = factor_of(number);
        const cv::Size size = enlarged(picture.size(), factor);
        const cv::Size windows = windows_in(size);
        if (windows.empty()) return people;
        const auto patches = patches_of(
            wanted_cells(windows, [&](int column, int row) { return wanted(number, person_in(column, row, factor)); }));
        if (patches.empty()) continue;
        const cv::Mat level = with_margin(picture, size);
        for (const cv::Rect& cells : patches) find_in_patch(level, cells, factor, people);
    }
}

void Hog::find_in_patch(const cv::Mat& level, const cv::Rect& cells, double factor,
                        std::vector<vision::Detection>& people) const {
    const cv::Rect patch{cells.x * step_px, cells.y * step_px, (cells.width - 1) * step_px + window_width_px,
                         (cells.height - 1) * step_px + window_height_px};
    std::vector<cv::Point> corners;
    std::vector<double> margins;
    descriptor_.detect(level(patch), corners, margins, settings_.least_margin, {step_px, step_px});
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const cv::Point window = corners[i] / step_px + cells.tl();
        people.push_back({person_in(window.x, window.y, factor), static_cast<float>(margins[i]), {}});
    }
}

} // namespace locus::camera
