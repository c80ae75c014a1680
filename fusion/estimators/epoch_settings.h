// What the estimators behind Chan-Taylor have in common in their settings. The held error of a range is that
// of range_ekf_settings.h, with the source named there. An epoch of 0.2 s: TREK1000 and its kin go round all anchors in
// 0.1 s, and one round may be lost.
#pragma once

#include "fusion/estimators/reading_settings.h"

namespace locus {

struct EpochEstimatorSettings : ReadingSettings {
    double anchor_error_sigma_m = 0.2;
    double epoch_s = 0.2;
    double speed_sigma_mps = 1;
    bool planar = false;
    double height_m = 0;
};

template <class Settings>
inline constexpr std::array epoch_gathering_options{
    option<&Settings::anchor_error_sigma_m, Settings>(
        "anchor_error_sigma_m", "m", 0, 100,
        "Error of an anchor that stays while the pose hardly changes (antenna, body, multipath)."),
    option<&Settings::epoch_s, Settings>(
        "epoch_s", "s", 0.001, 10,
        "Time that one position is made from: long enough for the tag to hear all anchors once."),
    option<&Settings::speed_sigma_mps, Settings>(
        "speed_sigma_mps", "m/s", 0.001, 1000,
        "Speed of the target: how far it goes within an epoch, and between a position and the next.")};

template <class Settings>
inline constexpr std::array epoch_plane_options{
    option<&Settings::planar, Settings>("planar", "", -no_limit, no_limit,
                                        "Whether the height is known and only x and y are estimated."),
    option<&Settings::height_m, Settings>("height_m", "m", -1e5, 1e5, "Height of the tag when planar."),
};

/// The rows of a table whose settings derive from EpochEstimatorSettings.
template <class Settings>
inline constexpr auto epoch_estimator_options =
    joined(joined(reading_options<Settings>, epoch_gathering_options<Settings>), epoch_plane_options<Settings>);

} // namespace locus
