// What the two detectors that look for outlines have in common. For .cpp files of this room only.
#pragma once

#include "drivers/camera/chance.h"
#include "drivers/camera/height_map.h"
#include "drivers/camera/hog.h"
#include "drivers/camera/person_shape.h"
#include "fusion/option.h"

#include <array>
#include <vector>

namespace locus::camera {

template <class Settings>
inline constexpr std::array hog_options{
    option<&HogSettings::least_outline_px, Settings>(
        "least_outline_px", "px", 16, 500, "Height from which outlines are looked for: small ones cost most."),
    option<&HogSettings::least_margin, Settings>("least_margin", "", -2, 5,
                                                 "Margin of the support vector machine from which somebody is there."),
    option<&HogSettings::scale_step, Settings>("scale_step", "", 1.01, 2,
                                               "From one size that is looked for to the next; larger is faster."),
    option<&HogSettings::most_iou, Settings>("most_iou", "", 0, 1,
                                             "Overlap (intersection over union) of two people's boxes at most."),
};
/// One size of so many is looked for everywhere in each picture, whatever else is known.
inline constexpr std::size_t turns = 16;

/// Where no height is known all sizes are possible.
inline bool is_possible(const vision::BoxPx& box, const HeightMap& heights) {
    if (!heights.is_known()) return true;
    const auto expected = heights.at(foot_x_px(box), box.bottom_px());
    return expected && has_expected_height(box.height_px, *expected);
}

/// In place of margins; what moves without an outline has the share of its box as its margin.
inline std::vector<vision::Detection> with_chances(std::vector<vision::Detection> people) {
    for (auto& person : people) person.score = chance_of_margin(person.score);
    return people;
}

} // namespace locus::camera
