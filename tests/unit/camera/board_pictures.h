// Pictures of a chessboard as a known lens takes them: drawn, laid into an ideal camera's picture by its homography,
// and from there bent into the lens's.
#pragma once

#include "fusion/vision/lens.h"

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

namespace locus::camera_test {

inline constexpr int board_columns = 9, board_rows = 6; ///< inner corners
inline constexpr double board_square_m = 0.03;

/// Black and white squares in a white border; `square` px each.
inline cv::Mat drawn_board(int square) {
    cv::Mat board((board_rows + 3) * square, (board_columns + 3) * square, CV_8UC1, cv::Scalar(255));
    for (int row = 0; row <= board_rows; ++row)
        for (int column = row % 2; column <= board_columns; column += 2)
            board(cv::Rect((column + 1) * square, (row + 1) * square, square, square)) = 0;
    return board;
}

class BoardCamera {
  public:
    BoardCamera(const vision::Lens& lens, cv::Size image) : map_(image, CV_32FC2) {
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const auto ray = vision::unproject(lens, {x + 0.5, y + 0.5});
                const bool is_in_front = ray && ray->z() > 0.3;
                map_.at<cv::Vec2f>(y, x) =
                    is_in_front
                        ? cv::Vec2f(static_cast<float>(ideal_focal_px * ray->x() / ray->z() + ideal_side_px / 2.),
                                    static_cast<float>(ideal_focal_px * ray->y() / ray->z() + ideal_side_px / 2.))
                        : cv::Vec2f(-1, -1);
            }
    }

    /// The board's middle is at `middle_m` in the camera's axes; `turn` is a rotation vector, rad.
    cv::Mat picture(const Eigen::Vector3d& turn, const Eigen::Vector3d& middle_m) const {
        const double angle = turn.norm();
        const Eigen::Matrix3d rotation =
            Eigen::AngleAxisd(angle, angle > 0 ? Eigen::Vector3d(turn / angle) : Eigen::Vector3d::UnitX())
                .toRotationMatrix();
        Eigen::Matrix3d camera_from_plane = rotation;
        camera_from_plane.col(2) = middle_m;
        Eigen::Matrix3d plane_from_drawing = Eigen::Matrix3d::Identity() * board_square_m / square_px;
        plane_from_drawing.col(2) << -board_square_m * (board_columns + 3) / 2.,
            -board_square_m * (board_rows + 3) / 2., 1;
        plane_from_drawing.col(2).head<2>().array() += 0.5 * board_square_m / square_px; // of a pixel's middle
        Eigen::Matrix3d ideal = Eigen::Vector3d(ideal_focal_px, ideal_focal_px, 1).asDiagonal();
        ideal.col(2) << ideal_side_px / 2., ideal_side_px / 2., 1;
        const Eigen::Matrix3d h = ideal * camera_from_plane * plane_from_drawing;
        const cv::Mat whole =
            (cv::Mat_<double>(3, 3) << h(0, 0), h(0, 1), h(0, 2), h(1, 0), h(1, 1), h(1, 2), h(2, 0), h(2, 1), h(2, 2));
        cv::Mat flat, bent, coloured;
        cv::warpPerspective(drawn_board(square_px), flat, whole, {ideal_side_px, ideal_side_px}, cv::INTER_AREA,
                            cv::BORDER_CONSTANT, cv::Scalar(120));
        cv::GaussianBlur(flat, flat, {}, 1.2);
        cv::remap(flat, bent, map_, {}, cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar(120));
        cv::Mat noise(bent.size(), CV_8SC1);
        cv::theRNG().state = 7;
        cv::randn(noise, 0, 2);
        cv::add(bent, noise, bent, {}, CV_8UC1);
        cv::cvtColor(bent, coloured, cv::COLOR_GRAY2BGR);
        return coloured;
    }

  private:
    static constexpr int square_px = 40, ideal_side_px = 2400;
    static constexpr double ideal_focal_px = 900;
    cv::Mat map_; ///< from the lens's pixels to the ideal camera's
};

} // namespace locus::camera_test
