#include "drivers/camera/annotate.h"

#include "drivers/camera/mat.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <vector>

namespace locus::camera {
namespace {

const cv::Scalar named_colour(80, 220, 80), unnamed_colour(60, 190, 250), hidden_colour(160, 160, 160);
const cv::Scalar floor_colour(200, 160, 60), axis_colour(60, 60, 220);
constexpr int grid_reach_m = 20, labels_every_m = 5;
constexpr double grid_step_m = 0.25; // short enough that a lens's bend shows

cv::Point pixel(const Eigen::Vector2d& at_px) { return {cvRound(at_px.x()), cvRound(at_px.y())}; }

void write(cv::Mat& image, const std::string& text, const cv::Point& at, const cv::Scalar& colour) {
    const double size = std::max(0.4, image.rows / 1200.);
    cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, size, cv::Scalar(0, 0, 0), 3, cv::LINE_AA);
    cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, size, colour, 1, cv::LINE_AA);
}

/// From one place of the floor to another, as far as the camera sees it.
void draw_floor_line(cv::Mat& image, const vision::FloorView& floor, Eigen::Vector2d from_m,
                     const Eigen::Vector2d& to_m, const cv::Scalar& colour) {
    const double length_m = (to_m - from_m).norm();
    const Eigen::Vector2d step_m = (to_m - from_m) * (grid_step_m / length_m);
    auto before = vision::pixel_of_floor(floor, from_m);
    const auto steps = std::lround(length_m / grid_step_m);
    for (long step = 0; step < steps; ++step) {
        from_m += step_m;
        const auto here = vision::pixel_of_floor(floor, from_m);
        const bool seen = before.has_value() && here.has_value() && before->cwiseAbs().maxCoeff() < max_side_px &&
                          here->cwiseAbs().maxCoeff() < max_side_px;
        if (seen) cv::line(image, pixel(before.value()), pixel(here.value()), colour, 1, cv::LINE_AA);
        before = here;
    }
}

void label(cv::Mat& image, const vision::FloorView& floor, const Eigen::Vector2d& at_m) {
    const auto at = vision::pixel_of_floor(floor, at_m);
    if (!at.has_value() || !cv::Rect(0, 0, image.cols, image.rows).contains(pixel(at.value()))) return;
    write(image, cv::format("%.0f,%.0f", at_m.x(), at_m.y()), pixel(at.value()), floor_colour);
}

/// Around the place that is seen in the lower middle of the picture.
void draw_floor(cv::Mat& image, const vision::FloorView& floor) {
    const vision::PixelPoint middle{{image.cols / 2., image.rows * 0.75}, Eigen::Matrix2d::Identity()};
    const auto seen = vision::foot_on_floor(floor, middle);
    if (!seen.has_value()) return;
    const Eigen::Vector2d centre_m = seen.value().position_site_m.array().round();
    for (int i = -grid_reach_m; i <= grid_reach_m; ++i)
        for (int axis = 0; axis < 2; ++axis) {
            Eigen::Vector2d from_m = centre_m, to_m = centre_m;
            from_m(axis) = to_m(axis) = centre_m(axis) + i;
            from_m(1 - axis) -= grid_reach_m;
            to_m(1 - axis) += grid_reach_m;
            draw_floor_line(image, floor, from_m, to_m, from_m(axis) == 0 ? axis_colour : floor_colour);
        }
    for (int x = -grid_reach_m; x <= grid_reach_m; x += labels_every_m)
        for (int y = -grid_reach_m; y <= grid_reach_m; y += labels_every_m)
            label(image, floor, centre_m + Eigen::Vector2d(x, y));
}

void draw_track(cv::Mat& image, const vision::ImageTrack& track, const TrackNames& names) {
    const auto name = names.find(track.id);
    const bool hidden = track.occluded || track.unseen_s > 0;
    const cv::Scalar colour = hidden ? hidden_colour : name == names.end() ? unnamed_colour : named_colour;
    const cv::Point corner(cvRound(track.box.left_px), cvRound(track.box.top_px));
    cv::rectangle(image, cv::Rect(corner, cv::Size(cvRound(track.box.width_px), cvRound(track.box.height_px))), colour,
                  2);
    cv::circle(image, pixel(track.foot_px), 4, colour, cv::FILLED, cv::LINE_AA);
    const std::string text = std::to_string(track.id) + (name == names.end() ? "" : " " + name->second);
    write(image, text, corner - cv::Point(0, 4), colour);
}

void make_colour(Picture& picture) {
    if (picture.channels == 3) return;
    Picture colour;
    colour.resize(picture.width_px, picture.height_px, 3);
    cv::Mat to = as_mat(colour);
    cv::cvtColor(as_mat(picture), to, cv::COLOR_GRAY2BGR);
    picture = std::move(colour);
}

} // namespace

void annotate(Picture& picture, std::span<const vision::ImageTrack> tracks, const TrackNames& names,
              const std::optional<vision::FloorView>& floor) {
    make_colour(picture);
    cv::Mat image = as_mat(picture);
    if (floor.has_value()) draw_floor(image, floor.value());
    for (const vision::ImageTrack& track : tracks) draw_track(image, track, names);
}

std::string to_jpeg(const Picture& picture) {
    std::vector<unsigned char> bytes;
    cv::imencode(".jpg", as_mat(picture), bytes);
    return {bytes.begin(), bytes.end()};
}

bool write_picture(const std::string& path, const std::string& jpeg, std::string& error) {
    std::string bytes = jpeg;
    if (std::filesystem::path(path).extension() == ".png") {
        const cv::Mat image = cv::imdecode(std::vector<char>(jpeg.begin(), jpeg.end()), cv::IMREAD_COLOR);
        std::vector<unsigned char> png;
        if (!image.empty()) cv::imencode(".png", image, png);
        bytes.assign(png.begin(), png.end());
    }
    std::ofstream file(path, std::ios::binary);
    file << bytes;
    const bool written = !bytes.empty() && file.flush().good();
    if (!written) error = "'" + path + "' cannot be written";
    return written;
}

} // namespace locus::camera
