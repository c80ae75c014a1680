// What a tracker can be told. Where a default is a paper's, frames are turned into seconds at 30 a second: SORT (Bewley
// et al. 2016), DeepSORT (Wojke et al. 2017), ByteTrack (Zhang et al. 2022). The others have a word of reason each.
#pragma once

#include "fusion/option.h"
#include "fusion/vision/box_filter.h"

#include <array>
#include <cstdint>

namespace locus::vision {

struct TrackerSettings : BoxNoise {
    double gate = 9.4877;                 ///< DeepSORT: 95 % of chi-square with four degrees of freedom
    double least_iou = 0.3;               ///< SORT and DeepSORT, of the stage by overlap
    double strong_score = 0.6;            ///< ByteTrack
    double first_score = 0.7;             ///< ByteTrack: 0.1 above the strong ones
    double weak_iou = 0.5;                ///< ByteTrack, of its second association
    std::uint32_t confirming_hits = 3;    ///< DeepSORT's n_init
    double lost_s = 3;                    ///< DeepSORT has 1 s; a walker needs 3 s to pass behind a van or a group
    double shown_unseen_s = 0.3;          ///< a few frames, in which a prediction is as good as a detection
    double covered_share = 0.5;           ///< half a person is what most detectors need
    double whole_height = 0.85;           ///< shorter by more than the error of an edge
    double max_appearance_distance = 0.2; ///< DeepSORT
    double appearance_weight = 0.5;       ///< DeepSORT has 1, for cameras that move; ours stand still
    std::uint32_t gallery = 100;          ///< DeepSORT
    double max_speed_mps = 3;             ///< people hurry at 2 m/s and seldom run
    bool cascade = false; ///< DeepSORT has it; the likelihood does the same and is better (docs/cameras.md)
};

namespace tracker_rows {
template <auto Member>
constexpr OptionRow row(std::string_view name, std::string_view unit, double minimum, double maximum,
                        std::string_view about) {
    return option<Member, TrackerSettings>(name, unit, minimum, maximum, about);
}
} // namespace tracker_rows

inline constexpr std::array tracker_options{
    tracker_rows::row<&BoxNoise::edge>("edge_sigma", "box heights", 1e-3, 1,
                                       "Standard deviation of one edge of a detected box."),
    tracker_rows::row<&BoxNoise::acceleration>("acceleration", "box heights/s^1.5", 1e-3, 10,
                                               "How fast people change their pace: density of white acceleration."),
    tracker_rows::row<&BoxNoise::start_speed>("start_speed_sigma", "box heights/s", 1e-2, 10,
                                              "Standard deviation of the speed of somebody who appears."),
    tracker_rows::row<&BoxNoise::size_change>("size_change", "box heights/s^0.5", 1e-3, 10,
                                              "How fast a box grows or shrinks."),
    option<&TrackerSettings::gate>(
        "gate", "", 1, 100, "Largest squared Mahalanobis distance (four numbers) at which a detection may be his."),
    option<&TrackerSettings::least_iou>("least_iou", "", 0.01, 1,
                                        "Least overlap at which a detection left over is given to a track left over."),
    option<&TrackerSettings::strong_score>(
        "strong_score", "", -1e6, 1e6, "Detections below it only prolong tracks that nothing better was found for."),
    option<&TrackerSettings::first_score>("first_score", "", -1e6, 1e6, "Detections below it start no track."),
    option<&TrackerSettings::weak_iou>("weak_iou", "", 0.01, 1, "Least overlap of a weak detection with its track."),
    option<&TrackerSettings::confirming_hits>("confirming_hits", "", 1, 100,
                                              "Detections in a row that make a track of a suspicion."),
    option<&TrackerSettings::lost_s>("lost_s", "s", 0, 60, "How long somebody unseen can be found again."),
    option<&TrackerSettings::shown_unseen_s>("shown_unseen_s", "s", 0, 60,
                                             "How long somebody unseen is shown whom nobody covers."),
    option<&TrackerSettings::covered_share>("covered_share", "", 0.05, 1,
                                            "Share of a box behind somebody nearer, from which it counts as occluded."),
    option<&TrackerSettings::whole_height>("whole_height", "", 0.1, 1,
                                           "Share of the expected height; an occluded box below it shows no feet."),
    option<&TrackerSettings::max_appearance_distance>("max_appearance_distance", "", 0, 2,
                                                      "One minus the likeness, above which it is somebody else."),
    option<&TrackerSettings::appearance_weight>("appearance_weight", "", 0, 1,
                                                "Weight of looks against that of motion, where looks are known."),
    option<&TrackerSettings::gallery>("gallery", "", 0, 1000, "How many looks of a track are remembered."),
    option<&TrackerSettings::max_speed_mps>("max_speed_mps", "m/s", 0.1, 20,
                                            "Nobody is found again where he had to walk faster; needs a calibration."),
    option<&TrackerSettings::cascade>("cascade", "Tracks seen last choose first, as in DeepSORT.")};

} // namespace locus::vision
