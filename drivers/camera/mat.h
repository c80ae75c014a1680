// A picture as OpenCV sees it, without a copy. For .cpp files of this room only.
#pragma once

#include "drivers/camera/picture.h"

#include <opencv2/core.hpp>

namespace locus::camera {

inline cv::Mat as_mat(Picture& picture) {
    return {picture.height_px, picture.width_px, CV_8UC(picture.channels), picture.pixels.data()};
}

/// Only to be read: OpenCV knows no view of constant pixels.
inline const cv::Mat as_mat(const Picture& picture) { // NOLINT(readability-const-return-type): that nobody writes
    auto* pixels = const_cast<std::uint8_t*>(picture.pixels.data()); // NOLINT(cppcoreguidelines-pro-type-const-cast)
    return {picture.height_px, picture.width_px, CV_8UC(picture.channels), pixels};
}

} // namespace locus::camera
