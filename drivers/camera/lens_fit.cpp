#include "drivers/camera/lens_fit.h"

#include <Eigen/LU>
#include <opencv2/calib3d.hpp>

#include <array>
#include <cmath>

namespace locus::camera {
namespace {

constexpr double half_a_pixel = 0.5;
constexpr std::size_t axes = 4; // fx, fy, cx, cy stand before the distortion in every table here
constexpr std::array<const char*, 9> pinhole_names{"fx_px", "fy_px", "cx_px", "cy_px", "k1", "k2", "p1", "p2", "k3"};
constexpr std::array<const char*, 8> fisheye_names{"fx_px", "fy_px", "cx_px", "cy_px", "k1", "k2", "k3", "k4"};

/// The boards as OpenCV takes them, and what it makes of them.
struct Calibration {
    std::vector<std::vector<cv::Point3f>> places_m;
    std::vector<std::vector<cv::Point2f>> corners_px;
    cv::Mat matrix, distortion;
    std::vector<cv::Mat> turns, shifts;
    bool is_fisheye = false;
    std::size_t free = 0; ///< parameters of the lens that were fitted
};

std::vector<cv::Point3f> places_of(const BoardShape& shape) {
    std::vector<cv::Point3f> places;
    for (int row = 0; row < shape.rows; ++row)
        for (int column = 0; column < shape.columns; ++column)
            places.emplace_back(static_cast<float>(column * shape.square_m), static_cast<float>(row * shape.square_m),
                                0.F);
    return places;
}

std::vector<cv::Point2f> from_middle(const BoardCorners& corners) {
    std::vector<cv::Point2f> out;
    for (const auto& corner : corners)
        out.emplace_back(static_cast<float>(corner.x() - half_a_pixel), static_cast<float>(corner.y() - half_a_pixel));
    return out;
}

void calibrate(Calibration& c, const cv::Size& image, bool with_k3) {
    if (c.is_fisheye) {
        constexpr int flags = cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC | cv::fisheye::CALIB_FIX_SKEW;
        cv::fisheye::calibrate(c.places_m, c.corners_px, image, c.matrix, c.distortion, c.turns, c.shifts, flags);
    } else
        cv::calibrateCamera(c.places_m, c.corners_px, image, c.matrix, c.distortion, c.turns, c.shifts,
                            with_k3 ? 0 : cv::CALIB_FIX_K3);
    c.free = c.is_fisheye || !with_k3 ? 8 : 9;
}

/// Errors of one board's corners, and how they move with lens and place.
struct BoardErrors {
    Eigen::VectorXd error_px;
    Eigen::MatrixXd by_lens, by_place;
};

BoardErrors errors_of(const Calibration& c, std::size_t board) {
    std::vector<cv::Point2f> shown;
    cv::Mat slopes;
    if (c.is_fisheye)
        cv::fisheye::projectPoints(c.places_m[board], shown, c.turns[board], c.shifts[board], c.matrix, c.distortion, 0,
                                   slopes);
    else
        cv::projectPoints(c.places_m[board], c.turns[board], c.shifts[board], c.matrix, c.distortion, shown, slopes);
    const auto free = static_cast<int>(c.free);
    const int lens = c.is_fisheye ? 0 : 6, place = c.is_fisheye ? 8 : 0; // columns of OpenCV's manual
    BoardErrors out{Eigen::VectorXd(2 * shown.size()), Eigen::MatrixXd(slopes.rows, free),
                    Eigen::MatrixXd(slopes.rows, 6)};
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const cv::Point2f error = c.corners_px[board][i] - shown[i];
        out.error_px.segment<2>(static_cast<Eigen::Index>(2 * i)) = Eigen::Vector2d(error.x, error.y);
    }
    for (int row = 0; row < slopes.rows; ++row) {
        for (int i = 0; i < free; ++i) out.by_lens(row, i) = slopes.at<double>(row, lens + i);
        for (int i = 0; i < 6; ++i) out.by_place(row, i) = slopes.at<double>(row, place + i);
    }
    return out;
}

/// Standard deviations of the lens's parameters, the boards' places taken out of the normal equations by Schur's
/// complement (Hartley and Zisserman 2004, appendix 6.3).
void tell_sigmas(const Calibration& c, LensFit& fit) {
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(static_cast<int>(c.free), static_cast<int>(c.free));
    double square_px2 = 0, numbers = 0;
    for (std::size_t board = 0; board < c.turns.size(); ++board) {
        const BoardErrors errors = errors_of(c, board);
        const Eigen::MatrixXd own = errors.by_place.transpose() * errors.by_place;
        const Eigen::MatrixXd mixed = errors.by_place.transpose() * errors.by_lens;
        information += errors.by_lens.transpose() * errors.by_lens - mixed.transpose() * own.ldlt().solve(mixed);
        square_px2 += errors.error_px.squaredNorm();
        numbers += static_cast<double>(errors.error_px.size());
        cv::Mat turn;
        cv::Rodrigues(c.turns[board], turn);
        fit.boards.push_back(
            {std::sqrt(2 * errors.error_px.squaredNorm() / static_cast<double>(errors.error_px.size())),
             {turn.at<double>(0, 2), turn.at<double>(1, 2), turn.at<double>(2, 2)}});
    }
    const double unknowns = static_cast<double>(c.free) + 6 * static_cast<double>(c.turns.size());
    const Eigen::MatrixXd covariance = square_px2 / (numbers - unknowns) * information.inverse();
    for (std::size_t i = 0; i < c.free; ++i)
        fit.parameters[i].sigma = std::sqrt(covariance(static_cast<int>(i), static_cast<int>(i)));
    fit.rms_px = std::sqrt(2 * square_px2 / numbers);
}

LensFit told(const Calibration& c) {
    LensFit fit;
    const std::array<double, axes> own{c.matrix.at<double>(0, 0), c.matrix.at<double>(1, 1), c.matrix.at<double>(0, 2),
                                       c.matrix.at<double>(1, 2)};
    for (std::size_t i = 0; i < c.free; ++i)
        fit.parameters.push_back({c.is_fisheye ? fisheye_names[i] : pinhole_names[i],
                                  i < axes ? own[i] : c.distortion.at<double>(static_cast<int>(i - axes)), 0});
    const auto k = [&](std::size_t i) { return axes + i < c.free ? fit.parameters[axes + i].value : 0; };
    const Eigen::Vector2d focal_px(own[0], own[1]), centre_px(own[2] + half_a_pixel, own[3] + half_a_pixel);
    if (c.is_fisheye)
        fit.lens = vision::FisheyeLens{focal_px, centre_px, {k(0), k(1), k(2), k(3)}};
    else
        fit.lens = vision::PinholeLens{focal_px, centre_px, {k(0), k(1), k(4), 0, 0, 0}, {k(2), k(3)}};
    tell_sigmas(c, fit);
    return fit;
}

} // namespace

std::optional<LensFit> fit_lens(std::span<const BoardCorners> boards, const BoardShape& shape,
                                const Eigen::Vector2d& image_px, bool is_fisheye, std::string& error) {
    Calibration c;
    c.is_fisheye = is_fisheye;
    c.places_m.assign(boards.size(), places_of(shape));
    for (const BoardCorners& corners : boards) c.corners_px.push_back(from_middle(corners));
    const cv::Size image(static_cast<int>(image_px.x()), static_cast<int>(image_px.y()));
    try {
        calibrate(c, image, true);
        LensFit fit = told(c);
        if (is_fisheye || std::abs(fit.parameters.back().value) > 3 * fit.parameters.back().sigma) return fit;
        calibrate(c, image, false);
        return told(c);
    } catch (const cv::Exception& exception) {
        error = "OpenCV finds no lens that shows these boards (" + exception.err + ")";
        return std::nullopt;
    }
}

} // namespace locus::camera
