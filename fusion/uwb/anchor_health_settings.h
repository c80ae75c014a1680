// When an anchor is called bad. The noise is what the range filter takes it for (range_ekf_settings.h). An error of
// less than 0.4 m, twice the held error, is no news: anchors have such errors everywhere, of antennas and of surveys.
#pragma once

#include "fusion/option.h"

#include <array>

namespace locus::uwb {

struct AnchorHealthSettings {
    double range_sigma_m = 0.1;
    double range_difference_sigma_m = 0.2;
    double held_error_sigma_m = 0.2;
    double held_error_time_s = 0.3;
    double common_range_error_sigma_m = 0.5;
    double least_error_m = 0.4;
    double false_alarm = 1e-6;
    double path_memory_s = 2;
    double anchor_memory_s = 60;
    double silent_after_s = 5;
};

inline constexpr std::array anchor_health_options{
    option<&AnchorHealthSettings::range_sigma_m>(
        "range_sigma_m", "m", 0.001, 100, "Noise of a range where neither the device nor the anchor states one."),
    option<&AnchorHealthSettings::range_difference_sigma_m>(
        "range_difference_sigma_m", "m", 0.001, 100,
        "Noise of a range difference where neither the device nor the anchors state one."),
    option<&AnchorHealthSettings::held_error_sigma_m>("held_error_sigma_m", "m", 0, 100,
                                                      "Error that an anchor in good health may have for a while."),
    option<&AnchorHealthSettings::held_error_time_s>("held_error_time_s", "s", 0.01, 1e6,
                                                     "Time in which that error becomes another one."),
    option<&AnchorHealthSettings::common_range_error_sigma_m>("common_range_error_sigma_m", "m", 0, 100,
                                                              "Constant error common to all ranges of a tag."),
    option<&AnchorHealthSettings::least_error_m>("least_error_m", "m", 0.01, 100,
                                                 "Errors and displacements below this are not called bad."),
    option<&AnchorHealthSettings::false_alarm>("false_alarm", "", 1e-12, 0.1,
                                               "Chance that one test calls a good anchor bad."),
    option<&AnchorHealthSettings::path_memory_s>(
        "path_memory_s", "s", 0.01, 600, "Over how long the path from an anchor to one tag is judged (blocked)."),
    option<&AnchorHealthSettings::anchor_memory_s>("anchor_memory_s", "s", 1, 1e5,
                                                   "Over how long an anchor is judged by all tags (moved)."),
    option<&AnchorHealthSettings::silent_after_s>("silent_after_s", "s", 0.1, 1e5,
                                                  "An anchor unheard for this long, by whatever tag, is silent."),
};

} // namespace locus::uwb
