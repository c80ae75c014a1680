// What can be set of the estimator `visual_scale` beyond those of `inertial_ekf`. Where the defaults come from:
// - a key frame 0.02 m: ORB-SLAM's published error on hand-held sequences of a desk, which is about 0.01 m (Mur-Artal
//   2015, table III), and the lever between camera and tag that turns with the wearer.
// - drift 0.05 m per root of a metre: 2 % of the way after 6 m, 1 % after 25 m, 0.5 % after 100 m; paper 001 states 0.1
//   to 2 %. From 0.02 to 0.1 errors on a recording change by less than a tenth.
// - clocks that differ by 0.1 s: two devices on one host without synchronisation (a camera's exposure and transport).
// - a scale counts as known from 2 % on: then it adds no more than the odometry's own error may be.
// - an alignment may go into the pose from 15 % on: linear enough for its covariance to be true (a second order of 1
// %).
//   At 30 % simulated walkers had larger errors for two seconds than without a camera.
// - poses up to 2 s apart: in between a walker who speeds up by 0.5 m/s^2 is off a straight line by 0.25 m at most,
// which
//   is what anchors err by.
#pragma once

#include "fusion/estimators/inertial_ekf_settings.h"

namespace locus {

struct VisualScaleSettings : InertialEkfSettings {
    double key_frame_sigma_m = 0.02;
    double drift_m_rtm = 0.05;
    double time_offset_sigma_s = 0.1;
    double known_below = 0.02;
    double aligned_below = 0.15;
    double longest_gap_s = 2;
};

inline constexpr std::array visual_only_options{
    option<&VisualScaleSettings::key_frame_sigma_m>("key_frame_sigma_m", "m", 0.001, 10,
                                                    "Noise of a key frame's place that is new each time, once scaled."),
    option<&VisualScaleSettings::drift_m_rtm>("drift_m_rtm", "m/sqrt(m)", 0, 10,
                                              "How much the odometry's path drifts over the way walked."),
    option<&VisualScaleSettings::time_offset_sigma_s>(
        "time_offset_sigma_s", "s", 0, 10, "How much the odometry's clock may differ from the ranges'; 0: not at all."),
    option<&VisualScaleSettings::known_below>(
        "known_below", "", 1e-4, 1, "Relative standard deviation from which on the scale is told as a number."),
    option<&VisualScaleSettings::aligned_below>(
        "aligned_below", "", 1e-3, 1,
        "Relative standard deviation of the scale from which on the pose takes vision in."),
    option<&VisualScaleSettings::longest_gap_s>(
        "longest_gap_s", "s", 0.01, 60, "Between two poses further apart nobody knows where a range was heard."),
};

inline constexpr auto visual_scale_options = joined(inertial_options<VisualScaleSettings>, visual_only_options);

} // namespace locus
