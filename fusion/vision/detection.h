// What a detector says of one person in one image, without any picture library: the contract between drivers/camera,
// which looks at pixels, and the tracker, which must be testable on boxes from a file.
#pragma once

#include "fusion/measurement.h"

#include <vector>

namespace locus::vision {

/// A rectangle in the image, left-handed pixel axes from the upper left corner of the upper left pixel.
struct BoxPx {
    float left_px = 0;
    float top_px = 0;
    float width_px = 0;
    float height_px = 0;

    float right_px() const { return left_px + width_px; }
    float bottom_px() const { return top_px + height_px; }
};

/// How a person looks, as a vector of unit length, so that the likeness of two is their dot product whatever made them:
/// square roots of colour histograms (the product is then Bhattacharyya's coefficient) or a network's embedding.
/// Empty: not known. All of one camera have the same size.
using Appearance = std::vector<float>;

struct Detection {
    BoxPx box;
    float score = 1; ///< 0..1: the chance that it is somebody, as far as the detector can tell
    Appearance appearance;
    Looks looks{}; ///< of the same in few numbers, for who reads foot points
};

} // namespace locus::vision
