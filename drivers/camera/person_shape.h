// What a person looks like to a fixed camera, in numbers that are of people and not of a video.
#pragma once

#include "fusion/vision/detection.h"

namespace locus::camera {

/// Width over height of a pedestrian's box, mean over 250,000 frames (Dollar et al. 2012, "Pedestrian detection: an
/// evaluation of the state of the art", section 2.2.2).
inline constexpr float person_aspect = 0.41F;

/// Nobody is so much shorter or taller than expected: people of 1.2 to 2.2 m against 1.7 m.
inline constexpr float least_of_expected = 0.7F;
inline constexpr float most_of_expected = 1.3F;

inline bool has_expected_height(float height_px, float expected_px) {
    return height_px >= least_of_expected * expected_px && height_px <= most_of_expected * expected_px;
}

/// The box of a person who stands with his feet at a pixel.
inline vision::BoxPx standing_box(float foot_x_px, float foot_y_px, float height_px) {
    const float width_px = person_aspect * height_px;
    return {foot_x_px - width_px / 2, foot_y_px - height_px, width_px, height_px};
}

inline float foot_x_px(const vision::BoxPx& box) { return box.left_px + box.width_px / 2; }

} // namespace locus::camera
