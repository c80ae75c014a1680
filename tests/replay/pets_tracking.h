// The tracker on the PETS 2009 S2.L1 video, whatever found the people, against the annotated ones.
#pragma once

#include "fusion/vision/tracker.h"
#include "tests/replay/pets.h"

#include <algorithm>
#include <cstdio>
#include <vector>

namespace locus::test {

struct PetsFigures {
    TrackingScore score;
    std::vector<double> foot_error_m; ///< of matched boxes, on the floor

    double foot_m(double share) {
        std::sort(foot_error_m.begin(), foot_error_m.end());
        return foot_error_m.empty()
                   ? 0
                   : foot_error_m[static_cast<std::size_t>(share * static_cast<double>(foot_error_m.size() - 1))];
    }
};

/// How far apart two feet in the image are on the floor.
inline std::optional<double> floor_distance_m(const vision::FloorView& floor, const Eigen::Vector2d& a_px,
                                              const Eigen::Vector2d& b_px) {
    const auto a = vision::foot_on_floor(floor, {a_px, Eigen::Matrix2d::Identity()});
    const auto b = vision::foot_on_floor(floor, {b_px, Eigen::Matrix2d::Identity()});
    return a && b ? std::optional((a->position_site_m - b->position_site_m).norm()) : std::nullopt;
}

/// A frame of detections for each of people, in the annotations' pixels.
inline PetsFigures tracked(const vision::TrackerSettings& settings, const std::vector<BoxesOfFrame>& people,
                           const std::vector<std::vector<vision::Detection>>& detections,
                           const vision::FloorView& floor, bool uses_floor) {
    vision::Tracker tracker(settings, uses_floor ? std::optional(floor) : std::nullopt);
    TrackingScorer scorer;
    PetsFigures figures;
    for (std::size_t i = 0; i < people.size(); ++i) {
        BoxesOfFrame boxes;
        for (const auto& track :
             tracker.update(timestamp_from_s(1 + pets_frame_s * static_cast<double>(i)), detections[i]))
            boxes.push_back({track.id, track.box});
        for (const auto& [person, box] : scorer.add(people[i], boxes))
            if (const auto error = floor_distance_m(floor, foot_of(people[i][person].box), foot_of(boxes[box].box)))
                figures.foot_error_m.push_back(*error);
    }
    figures.score = scorer.score();
    return figures;
}

inline void print(const char* name, PetsFigures figures) {
    const TrackingScore& s = figures.score;
    std::printf("%-22s MOTA %.3f IDF1 %.3f switches %zu recall %.3f precision %.3f, foot %.3f m, 95 %% %.3f m\n", name,
                s.mota(), s.idf1(), s.switches, s.recall(), s.precision(), figures.foot_m(0.5), figures.foot_m(0.95));
}

} // namespace locus::test
