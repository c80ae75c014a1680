#include "drivers/camera/patches.h"

#include <opencv2/imgproc.hpp>

namespace locus::camera {
namespace {

constexpr int near_cells = 8; // a window is 8 cells wide

cv::Mat1b closed(const cv::Mat1b& marked) {
    cv::Mat1b joined;
    const auto brush = cv::getStructuringElement(cv::MORPH_RECT, {near_cells + 1, near_cells + 1});
    cv::morphologyEx(marked, joined, cv::MORPH_CLOSE, brush);
    return joined;
}

} // namespace

std::vector<cv::Rect> patches_of(const cv::Mat1b& marked) {
    std::vector<cv::Rect> patches;
    if (cv::countNonZero(marked) == 0) return patches;
    cv::Mat labels;
    cv::Mat statistics;
    cv::Mat centres;
    const int count = cv::connectedComponentsWithStats(closed(marked), labels, statistics, centres);
    for (int i = 1; i < count; ++i) { // 0 is what is not marked
        const auto value = [&](int column) { return statistics.at<int>(i, column); };
        patches.emplace_back(value(cv::CC_STAT_LEFT), value(cv::CC_STAT_TOP), value(cv::CC_STAT_WIDTH),
                             value(cv::CC_STAT_HEIGHT));
    }
    return patches;
}

} // namespace locus::camera
