#include "drivers/camera/chessboard.h"

#include "drivers/camera/mat.h"

#include <opencv2/calib3d.hpp>

namespace locus::camera {

std::optional<BoardCorners> find_chessboard(const Picture& picture, const BoardShape& shape) {
    std::vector<cv::Point2f> found;
    constexpr int flags = cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_ACCURACY;
    try {
        if (!cv::findChessboardCornersSB(as_mat(picture), {shape.columns, shape.rows}, found, flags))
            return std::nullopt;
    } catch (const cv::Exception&) { // a picture smaller than its filters
        return std::nullopt;
    }
    BoardCorners corners;
    for (const auto& corner : found) corners.emplace_back(corner.x + 0.5, corner.y + 0.5); // it counts from the middle
    return corners;
}

} // namespace locus::camera
