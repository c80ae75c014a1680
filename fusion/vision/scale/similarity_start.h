// The similarity between a SLAM's path and the site in closed form, from places that both know (Horn
// 1987, "Closed-form solution of absolute orientation using unit quaternions"; the scale is Umeyama's of 1991, eq. 43:
// all of the error is the places'), each weighed as a whole. As rough as the places are, but it needs no start.
#pragma once

#include "fusion/vision/scale/key_places.h"
#include "fusion/vision/scale/similarity.h"

#include <optional>

namespace locus::vision {

/// Empty: fewer than four places, or the SLAM has not moved at all.
std::optional<Similarity> start_of_similarity(std::span<const KeyPlace> places) noexcept;

} // namespace locus::vision
