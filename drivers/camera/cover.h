// Explains what moves by people. Boxes of the height that is expected at their feet are laid over the foreground, the
// one that explains most of it first, until the rest is nobody: so fragments of one body become one person and groups
// are parted, by one rule (the rectangles of Fleuret et al. 2008, "Multicamera people tracking with a probabilistic
// occupancy map", laid greedily). For .cpp files of this room only.
#pragma once

#include "fusion/vision/detection.h"

#include <opencv2/core.hpp>

#include <vector>

namespace locus::camera {

/// Of a box that stands about a walking person half the pixels are the person's; a third allows for clothes in the
/// background's colour, and for a person who is half hidden by another.
struct CoverSettings {
    double least_filled = 0.33;  ///< of the box's pixels that no nearer person explains
    double least_visible = 0.25; ///< of all its pixels
};

/// Of the `standing` boxes those that explain what moves, with their filled share as the score; what the boxes of
/// `known` people explain is left out.
std::vector<vision::Detection> cover(const cv::Mat& foreground, const std::vector<vision::BoxPx>& standing,
                                     const CoverSettings& settings, const std::vector<vision::Detection>& known = {});

/// How much of a box is marked (moves), for many boxes of one mask.
class BoxShares {
  public:
    BoxShares() = default;
    explicit BoxShares(const cv::Mat& foreground);
    /// Of the pixels that are inside the picture, 0..1; 0 where none is.
    float of(const vision::BoxPx& box) const;

  private:
    cv::Mat sums_; ///< over all above and left of each pixel
};

} // namespace locus::camera
