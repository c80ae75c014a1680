// How a person looks, in a few numbers that a pose of the body does not change much: colour histograms of head, torso
// and legs, square-rooted (so their product is Bhattacharyya's coefficient) and together of unit length.
#pragma once

#include "drivers/camera/picture.h"
#include "fusion/vision/detection.h"

namespace locus::camera {

/// Empty for grey pictures and for boxes with next to nothing of them inside the image.
vision::Appearance appearance(const Picture& picture, const vision::BoxPx& box);

/// The same in as few numbers as a foot point carries, for torso and for legs: eight hues however full the colour is,
/// and four greys. The head is left out: hair and skin tell less apart than clothes. All zero for what is no such
/// appearance.
Looks looks(const vision::Appearance& appearance) noexcept;

} // namespace locus::camera
