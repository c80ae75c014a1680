#include "drivers/camera/picture_file.h"

#include "drivers/camera/mat.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <filesystem>

namespace locus::camera {
namespace {

cv::Mat decoded_file(const std::string& path) {
    try {
        return cv::imread(path, cv::IMREAD_COLOR);
    } catch (const cv::Exception&) { // larger than OpenCV believes
        return {};
    }
}

} // namespace

std::optional<Picture> read_picture(const std::string& path, std::string& error) {
    std::error_code ignored;
    const bool is_there = std::filesystem::is_regular_file(path, ignored);
    const cv::Mat decoded = is_there ? decoded_file(path) : cv::Mat();
    if (decoded.empty() || std::max(decoded.cols, decoded.rows) > max_side_px) {
        error = "'" + path + "' " + (is_there ? "is no image that this machine can read" : "is not there");
        return std::nullopt;
    }
    Picture picture;
    picture.resize(decoded.cols, decoded.rows, 3);
    cv::Mat to = as_mat(picture);
    decoded.copyTo(to);
    return picture;
}

} // namespace locus::camera
