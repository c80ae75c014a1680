#include "drivers/camera/detector_rows.h"

#include <opencv2/core/utility.hpp>

#include <algorithm>
#include <array>

namespace locus::camera {

namespace {

/// A camera has one thread and takes one core: a pool of OpenCV's would inherit that thread's priority and cores, and
/// stand in the way of the fusion thread.
auto make_rows() {
    cv::setNumThreads(1);
    return std::array{motion_row(), hog_row(), hog_motion_row(), network_row()};
}

} // namespace

std::span<const DetectorRow> detector_table() {
    static const auto rows = make_rows();
    return rows;
}

const DetectorRow* find_detector(std::string_view name) {
    const auto rows = detector_table();
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const DetectorRow& each) { return each.name == name; });
    return row == rows.end() ? nullptr : &*row;
}

} // namespace locus::camera
