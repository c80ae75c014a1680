#include "tests/support/room/room_film.h"

#include <opencv2/imgproc.hpp>

namespace locus::room {
namespace {

/// How far the middle of the picture moves while the shutter is open, as a line: turning is most of it.
cv::Mat smear(const RoomView& opened, const RoomView& closed) {
    const Eigen::Vector3d ahead =
        opened.room_from_camera.conjugate() * (closed.room_from_camera * Eigen::Vector3d::UnitZ());
    const Eigen::Vector2d way_px = RoomScene::focal_px * ahead.hnormalized();
    const int half = static_cast<int>(std::ceil(way_px.cwiseAbs().maxCoeff() / 2)) + 1;
    cv::Mat fine = cv::Mat::zeros(8 * (2 * half + 1), 8 * (2 * half + 1), CV_32F), kernel;
    const cv::Point2d middle(4. * (2 * half + 1), 4. * (2 * half + 1)), end(4 * way_px.x(), 4 * way_px.y());
    cv::line(fine, middle - end, middle + end, {1}, 8);
    cv::resize(fine, kernel, {2 * half + 1, 2 * half + 1}, 0, 0, cv::INTER_AREA);
    return kernel / cv::sum(kernel)[0];
}

} // namespace

camera::Picture RoomFilm::with_noise(const cv::Mat& clean) {
    camera::Picture picture;
    picture.resize(clean.cols, clean.rows, 1);
    cv::Mat noise(clean.size(), CV_16S), image(clean.rows, clean.cols, CV_8U, picture.pixels.data());
    random_.fill(noise, cv::RNG::NORMAL, 0, settings_.noise);
    cv::add(clean, noise, image, cv::noArray(), CV_8U);
    return picture;
}

camera::Picture RoomFilm::at(double time_s) {
    cv::Mat image = scene_.picture(walk_.at(time_s));
    const double half_s = settings_.exposure_s / 2;
    cv::filter2D(image, image, -1, smear(walk_.at(time_s - half_s), walk_.at(time_s + half_s)));
    cv::GaussianBlur(image, image, {}, 0.5); // of the lens
    return with_noise(image);
}

camera::Picture RoomFilm::covered() {
    return with_noise(cv::Mat(RoomScene::height_px, RoomScene::width_px, CV_8U, cv::Scalar(12)));
}

} // namespace locus::room
