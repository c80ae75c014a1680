// A first view of the floor from four or more places whose pixels are known, in one step: the direct linear transform
// (Hartley and Zisserman 2004, section 4.1), and for a camera whose lens is known the turn and shift that are in it
// (Zhang 2000, section 3.1).
#pragma once

#include "fusion/vision/camera_model.h"
#include "fusion/vision/survey/floor_pair.h"

#include <optional>
#include <span>

namespace locus::vision::survey {

inline constexpr std::size_t least_pairs = 4;

/// Without a lens a homography. Empty where the pairs do not tell: too few, or too many of them on one line.
std::optional<FloorView> start_view(std::span<const FloorPair> pairs, const std::optional<Lens>& lens);

} // namespace locus::vision::survey
