// A walk from its start to its end: who in the image is the tagged person, how large the errors are, and one step of
// view and time offset, again and again until nothing changes.
#pragma once

#include "fusion/vision/survey/walk_start.h"

#include <cstddef>
#include <span>
#include <vector>

namespace locus::vision::survey {

/// Fewer feet tell nothing: a homography and an offset are nine numbers, and errors come in runs.
inline constexpr std::size_t least_feet = 30;

/// View, offset and who is whose, as they get better.
struct Walking {
    FloorView view{};
    double offset_s = 0;
    double spread = 1;
    std::vector<std::size_t> used{}; ///< feet
    std::vector<TimedPair> pairs{};  ///< of the feet used
    Eigen::Vector2d centre_m{0, 0};
    double cost = 0;
};

Walking walked_from(const WalkStart& start, std::span<const SeenFoot> feet, const TaggedPath& path,
                    const WalkSettings& settings);

} // namespace locus::vision::survey
