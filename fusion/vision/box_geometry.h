// What two rectangles have to do with each other.
#pragma once

#include "fusion/vision/detection.h"

#include <algorithm>

namespace locus::vision {

inline float area_px2(const BoxPx& box) { return std::max(box.width_px, 0.F) * std::max(box.height_px, 0.F); }

inline float overlap_px2(const BoxPx& a, const BoxPx& b) {
    const float width = std::min(a.right_px(), b.right_px()) - std::max(a.left_px, b.left_px);
    const float height = std::min(a.bottom_px(), b.bottom_px()) - std::max(a.top_px, b.top_px);
    return std::max(width, 0.F) * std::max(height, 0.F);
}

/// Intersection over union, 0..1.
inline float iou(const BoxPx& a, const BoxPx& b) {
    const float both = overlap_px2(a, b), either = area_px2(a) + area_px2(b) - both;
    return either > 0 ? both / either : 0;
}

/// The share of `box` that `other` lies over, 0..1.
inline float covered_share(const BoxPx& box, const BoxPx& other) {
    const float area = area_px2(box);
    return area > 0 ? overlap_px2(box, other) / area : 0;
}

} // namespace locus::vision
