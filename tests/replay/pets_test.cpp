// The tracker on PETS 2009 S2.L1 with the public detections of MOT15, against the annotated people. Figures are in
// docs/cameras.md; what is asserted is issue 5's aim where it is met, and elsewhere what is reached.
#include "config/camera_calibration.h"
#include "fusion/vision/tracker.h"
#include "tests/replay/pets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

namespace locus::test {
namespace {

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
std::optional<double> floor_distance_m(const vision::FloorView& floor, const Eigen::Vector2d& a_px,
                                       const Eigen::Vector2d& b_px) {
    const auto a = vision::foot_on_floor(floor, {a_px, Eigen::Matrix2d::Identity()});
    const auto b = vision::foot_on_floor(floor, {b_px, Eigen::Matrix2d::Identity()});
    return a && b ? std::optional((a->position_site_m - b->position_site_m).norm()) : std::nullopt;
}

PetsFigures tracked(const vision::TrackerSettings& settings, const std::vector<BoxesOfFrame>& people,
                    const vision::FloorView& floor, bool uses_floor) {
    const auto detections = public_detections(people.size());
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

void print(const char* name, PetsFigures figures) {
    const TrackingScore& s = figures.score;
    std::printf("%-22s MOTA %.3f IDF1 %.3f switches %zu recall %.3f precision %.3f, foot %.3f m, 95 %% %.3f m\n", name,
                s.mota(), s.idf1(), s.switches, s.recall(), s.precision(), figures.foot_m(0.5), figures.foot_m(0.95));
}

TEST(Pets, TrackerOnPublicDetections) {
    const auto people = annotations("PETS2009-S2L1.xml");
    const auto calibration = recorded("pets2009/data/calibration/View_001.xml");
    if (people.empty() || !calibration || !recorded("mot15_sort_det/PETS09-S2L1/det/det.txt"))
        GTEST_SKIP() << "no pets2009 or mot15_sort_det in LOCUS_DATA or ../shared/data";
    std::vector<ConfigProblem> problems;
    const auto camera = config::load_camera(calibration->string(), problems);
    ASSERT_TRUE(camera) << (problems.empty() ? "" : problems[0].message);
    const auto with = [&](auto change) {
        vision::TrackerSettings settings;
        change(settings);
        return tracked(settings, people, camera->view, true);
    };
    PetsFigures figures = with([](auto&) {});
    print("defaults", figures);
    print("without calibration", tracked({}, people, camera->view, false));
    print("cascade", with([](auto& s) { s.cascade = true; }));
    print("edge_sigma 0.07", with([](auto& s) { s.edge = 0.07; }));
    print("edge_sigma 0.12", with([](auto& s) { s.edge = 0.12; }));
    print("confirming_hits 1", with([](auto& s) { s.confirming_hits = 1; }));
    EXPECT_EQ(people.size(), 795u);
    EXPECT_EQ(figures.score.persons, 4650u);
    EXPECT_GE(figures.score.mota(), 0.68);
    EXPECT_GE(figures.score.idf1(), 0.60);
    EXPECT_LE(figures.score.switches, 45u) << "SORT has 76 to 92, ByteTrack 127";
    EXPECT_LE(figures.foot_m(0.5), 0.25) << "the detections' own feet; issue 5 aims at 0.15";
    EXPECT_LE(figures.foot_m(0.95), 0.8) << "the detections' own feet";
}

} // namespace
} // namespace locus::test
