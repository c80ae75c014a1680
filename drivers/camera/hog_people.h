// What the two detectors that look for outlines have in common. For .cpp files of this room only.
#pragma once

#include "drivers/camera/chance.h"
#include "drivers/camera/height_grid.h"
#include "drivers/camera/hog.h"
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

/// In place of margins; what moves without an outline has the share of its box as its margin.
inline std::vector<vision::Detection> with_chances(std::vector<vision::Detection> people) {
    for (auto& person : people) person.score = chance_of_margin(person.score);
    return people;
}

} // namespace locus::camera
