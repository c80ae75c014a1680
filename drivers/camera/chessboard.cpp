#include "drivers/camera/chessboard.h"

#include "drivers/camera/mat.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace locus::camera {
namespace {

/// A third of the way to the nearest corner: no other is within, and as many pixels as there are tell where it is.
int window_px(const std::vector<cv::Point2f>& corners) {
    double least_px = 60;
    for (std::size_t i = 1; i < corners.size(); ++i)
        least_px = std::min(least_px, cv::norm(corners[i] - corners[i - 1]));
    return std::max(2, static_cast<int>(least_px / 3));
}

/// Where the gradients around it point to: several times as sharp as what finds it.
void sharpen(const cv::Mat& picture, std::vector<cv::Point2f>& corners) {
    cv::Mat grey;
    cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
    const int window = window_px(corners);
    cv::cornerSubPix(grey, corners, {window, window}, {-1, -1},
                     {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 1e-3});
}

} // namespace

std::optional<BoardCorners> find_chessboard(const Picture& picture, const BoardShape& shape) {
    std::vector<cv::Point2f> found;
    constexpr int flags = cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_ACCURACY;
    try {
        if (!cv::findChessboardCornersSB(as_mat(picture), {shape.columns, shape.rows}, found, flags))
            return std::nullopt;
        sharpen(as_mat(picture), found);
    } catch (const cv::Exception&) { // a picture smaller than its filters
        return std::nullopt;
    }
    BoardCorners corners;
    for (const auto& corner : found) corners.emplace_back(corner.x + 0.5, corner.y + 0.5); // it counts from the middle
    return corners;
}

} // namespace locus::camera
