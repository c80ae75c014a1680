// What a reader of ranges and range differences must be told (range_reader.h), whatever estimator it reads for. Where
// the noise comes from: a range 0.1 m: the DW1000's product brief (+-10 cm). A difference 0.2 m: it takes three
// arrivals of that kind (the tag hears two anchors, one of them has heard the other), which makes 0.17 m. Two tags at
// rest in the identification runs of util_uwb_tdoa showed 0.05 m, so these leave room for what moves.
#pragma once

#include "fusion/option.h"

#include <array>

namespace locus {

struct ReadingSettings {
    double range_sigma_m = 0.1;
    double range_difference_sigma_m = 0.2;
    double max_range_m = 200;
    bool use_blocked = false;
};

/// `Settings`: those of an estimator that has these as a base.
template <class Settings>
inline constexpr std::array reading_options{
    option<&ReadingSettings::range_sigma_m, Settings>(
        "range_sigma_m", "m", 0.001, 100,
        "Noise of a range that is new each time, where neither the device nor the anchor states one."),
    option<&ReadingSettings::range_difference_sigma_m, Settings>(
        "range_difference_sigma_m", "m", 0.001, 100,
        "Noise of a range difference that is new each time, where neither the device nor the anchors state one."),
    option<&ReadingSettings::max_range_m, Settings>("max_range_m", "m", 0.1, 1e6,
                                                    "Longest range, or difference, believed."),
    option<&ReadingSettings::use_blocked, Settings>(
        "use_blocked", "Whether measurements are used that the device itself calls blocked."),
};

} // namespace locus
