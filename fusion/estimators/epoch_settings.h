// What the estimators behind Chan-Taylor have in common in their settings. Noise and held error of a range are those of
// range_ekf_settings.h, with the sources named there. An epoch of 0.2 s: TREK1000 and its kin go round all anchors in
// 0.1 s, and one round may be lost.
#pragma once

#include "fusion/option.h"

#include <array>

namespace locus {

struct EpochEstimatorSettings {
    double range_sigma_m = 0.1;
    double range_difference_sigma_m = 0.2;
    double anchor_error_sigma_m = 0.2;
    double epoch_s = 0.2;
    double speed_sigma_mps = 1;
    double max_range_m = 200;
    bool use_blocked = false;
    bool planar = false;
    double height_m = 0;
};

/// The rows of a table whose settings derive from EpochEstimatorSettings.
template <class Settings>
inline constexpr std::array epoch_estimator_options{
    option<&Settings::range_sigma_m, Settings>(
        "range_sigma_m", "m", 0.001, 100,
        "Noise of a range that is new each time, where neither the device nor the anchor states one."),
    option<&Settings::range_difference_sigma_m, Settings>(
        "range_difference_sigma_m", "m", 0.001, 100,
        "Noise of a range difference that is new each time, where neither the device nor the anchors state one."),
    option<&Settings::anchor_error_sigma_m, Settings>(
        "anchor_error_sigma_m", "m", 0, 100,
        "Error of an anchor that stays while the pose hardly changes (antenna, body, multipath)."),
    option<&Settings::epoch_s, Settings>(
        "epoch_s", "s", 0.001, 10,
        "Time that one position is made from: long enough for the tag to hear all anchors once."),
    option<&Settings::speed_sigma_mps, Settings>(
        "speed_sigma_mps", "m/s", 0.001, 1000,
        "Speed of the target: how far it goes within an epoch, and between a position and the next."),
    option<&Settings::max_range_m, Settings>("max_range_m", "m", 0.1, 1e6, "Longest range, or difference, believed."),
    option<&Settings::use_blocked, Settings>("use_blocked", "", -no_limit, no_limit,
                                             "Whether measurements are used that the device itself calls blocked."),
    option<&Settings::planar, Settings>("planar", "", -no_limit, no_limit,
                                        "Whether the height is known and only x and y are estimated."),
    option<&Settings::height_m, Settings>("height_m", "m", -1e5, 1e5, "Height of the tag when planar."),
};

} // namespace locus
