// What can be set of the range filter beyond reading_settings.h. Where the defaults come from:
// - anchors' held error 0.2 m: residuals against motion capture over its flights showed 0.13-0.18 m an anchor,
//   correlated for a tenth of a second to seconds; the upper end, rounded up, because the published bound stands on it.
// - anchors' offset 0.03 m for minutes: what a survey by laser and an antenna delay set in steps leave over. Twice as
//   much makes horizontal errors of two-way ranges less still, and heights worse. Differences have none: on four
//   flights it only made heights worse, by up to 4 %.
// - acceleration 3 m/s^2 for 0.1 s: people and small vehicles; it lets the velocity wander 1.3 m/s in a second.
// - robust scale 0.9: half the weight at about one standard deviation of the innovations as they come
//   (filter/robust_gain.h). Below 0.8 simulated tags in Gaussian noise begin to get lost; from 0.8 to 1.5 errors on
//   recordings change by 5 %, less being better on flights and more where ranges are clean.
// Some hundred sets of these were compared on six flights of util_uwb_tdoa, two of iasl_uwb_imu and isas_walk; the
// optimum is flat and the defaults lie within it. So these recordings do not prove them, others must.
#pragma once

#include "fusion/estimators/reading_settings.h"

namespace locus {

struct RangeEkfSettings : ReadingSettings {
    double anchor_error_sigma_m = 0.2;
    double anchor_error_time_s = 0.3;
    double anchor_offset_sigma_m = 0.03;
    double anchor_offset_time_s = 300;
    double common_range_error_sigma_m = 0.5;
    double acceleration_sigma_mps2 = 3;
    double acceleration_time_s = 0.1;
    double speed_sigma_mps = 1;
    double robust_scale = 0.9;
    double gate_false_alarm = 1e-4;
    int gate_patience = 10;
    double start_window_s = 0.5;
    double lost_after_s = 0.2;
    double forget_after_s = 3;
    bool planar = false;
    double height_m = 0;
};

template <class Settings>
inline constexpr std::array range_only_options{
    option<&RangeEkfSettings::anchor_error_sigma_m, Settings>(
        "anchor_error_sigma_m", "m", 0, 100,
        "Error of an anchor that stays while the pose hardly changes (antenna, body, multipath)."),
    option<&RangeEkfSettings::anchor_error_time_s, Settings>("anchor_error_time_s", "s", 0.01, 1e6,
                                                             "Time in which that error becomes another one."),
    option<&RangeEkfSettings::anchor_offset_sigma_m, Settings>(
        "anchor_offset_sigma_m", "m", 0, 100,
        "Constant error of each anchor's ranges that survey and calibration leave over, found as the tag moves."),
    option<&RangeEkfSettings::anchor_offset_time_s, Settings>(
        "anchor_offset_time_s", "s", 1, 1e6,
        "Time in which that offset becomes another one (temperature, rebuilding)."),
    option<&RangeEkfSettings::common_range_error_sigma_m, Settings>(
        "common_range_error_sigma_m", "m", 0, 100,
        "Constant error common to all ranges of a tag (antenna delay), found as it moves."),
    option<&RangeEkfSettings::acceleration_sigma_mps2, Settings>("acceleration_sigma_mps2", "m/s^2", 0.001, 1000,
                                                                 "Acceleration that the target is capable of."),
    option<&RangeEkfSettings::acceleration_time_s, Settings>(
        "acceleration_time_s", "s", 0.01, 1e4,
        "Time in which an acceleration dies away; very long: the constant acceleration of paper 001."),
    option<&RangeEkfSettings::speed_sigma_mps, Settings>("speed_sigma_mps", "m/s", 0.001, 1000,
                                                         "Speed that a target may have when it is first heard."),
    option<&RangeEkfSettings::robust_scale, Settings>(
        "robust_scale", "sigma", 0.1, 1e6,
        "Innovation, in standard deviations of those that come, with half the weight (Cauchy)."),
    option<&RangeEkfSettings::gate_false_alarm, Settings>("gate_false_alarm", "", 1e-12, 0.5,
                                                          "Chance that the gate refuses a good measurement."),
    option<&RangeEkfSettings::gate_patience, Settings>(
        "gate_patience", "", 0, 1000000, "Measurements of an anchor refused in a row before one is let in again."),
    option<&RangeEkfSettings::start_window_s, Settings>("start_window_s", "s", 0.01, 60,
                                                        "Age of the measurements that a first position is made from."),
    option<&RangeEkfSettings::lost_after_s, Settings>(
        "lost_after_s", "s", 0.01, 60, "How long most anchors are refused before the filter doubts itself."),
    option<&RangeEkfSettings::forget_after_s, Settings>("forget_after_s", "s", 0.1, 3600,
                                                        "Without a measurement for this long the filter starts anew."),
    option<&RangeEkfSettings::planar, Settings>("planar",
                                                "Whether the height is known and only x and y are estimated."),
    option<&RangeEkfSettings::height_m, Settings>("height_m", "m", -1e5, 1e5, "Height of the tag when planar."),
};

/// `Settings`: those of an estimator that has RangeEkfSettings as a base.
template <class Settings>
inline constexpr auto range_options = joined(reading_options<Settings>, range_only_options<Settings>);

inline constexpr auto range_ekf_options = range_options<RangeEkfSettings>;

} // namespace locus
