// Paper 001, sections 3.2 and 3.3: UWB and monocular SLAM in a room, three loops, and in a corridor of 65 m with ten
// anchors; RMSE in the plane 0.32 -> 0.18 m and 0.31 -> 0.17 m. Ranges five times a second with walk.h's noise and the
// walker's body in the way of the anchors behind him; the SLAM is slam_path.h's. In the room it is lost at two corners
// of the first and third loop, in the corridor twice on each way, for two seconds each time, and begins anew with
// another scale and rotation. "Paper" is the six-state filter with UWB positions of the nine-state filter by the
// letter.
#include "fusion/estimators/inertial_ekf.h"
#include "fusion/estimators/visual_scale.h"
#include "fusion/vision/scale/six_state.h"
#include "tests/papers/score.h"
#include "tests/papers/slam_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

namespace locus::papers::scaled {
namespace {

struct Stage {
    const char* name;
    double paper_uwb_m, paper_fused_m;
    Site site;
    Way way;
    double walked_s;
    std::vector<double> losses_s;
};

Site corridor_site() {
    std::vector<Vec3> anchors;
    for (int i = 0; i < 8; ++i) anchors.push_back({65.0 * i / 7, i % 2 == 0 ? 0.0 : 3.0, 2.5});
    anchors.push_back({65, 9, 2.5}); // the laboratory, 6 m by 8 m, at its end
    anchors.push_back({59, 9, 2.5});
    return site_of(anchors);
}

const Stage stages[]{
    {"room, three loops",
     0.32,
     0.18,
     site_of({{0, 0, 2.5}, {8, 0, 2.5}, {8, 6, 2.5}, {0, 6, 2.5}}),
     {{1, 1}, {7, 1}, {7, 5}, {1, 5}},
     51,
     {13, 39}},
    {"corridor, 65 m", 0.31, 0.17, corridor_site(), {{1, 1.5}, {62, 1.5}, {62, 7}, {60, 7}, {60, 1.5}}, 115, {35, 80}}};

constexpr double lost_s = 2, first_scored_s = 4;

RangeEkfSettings letter_of_the_paper() { // as in paper_001_test.cpp
    RangeEkfSettings settings;
    settings.anchor_error_sigma_m = settings.anchor_offset_sigma_m = settings.common_range_error_sigma_m = 0;
    settings.acceleration_time_s = 1e3;
    settings.acceleration_sigma_mps2 = std::sqrt(0.5 * settings.acceleration_time_s);
    settings.robust_scale = 1e6;
    settings.gate_false_alarm = 1e-12;
    return settings;
}

/// The paper's loose coupling: its own UWB filter's places and the vision's path into six states.
class PaperFilter {
  public:
    void hear(const Estimate& uwb, double time_s) {
        if (uwb.missing != Missing::nothing) return;
        const Eigen::Vector2d place_m = vector(uwb.position_site_m).head<2>();
        if (!filter_)
            filter_.emplace(vision::SixStateModel{}, vision::SixState::State{place_m.x(), place_m.y(), 1, 0, 1, 0},
                            0.3);
        move_to(time_s);
        filter_->hear(place_m, 0.3); // the paper's own figure of its UWB
    }
    void see(const Eigen::Vector2d& flat_odometry, std::uint32_t segment, double time_s) {
        if (!filter_) return;
        move_to(time_s);
        if (segment != segment_) begin(flat_odometry, segment);
        filter_->see(flat_odometry - began_odometry_, began_site_m_, 0.05);
    }
    Estimate result() const {
        Estimate estimate;
        if (!filter_) return estimate;
        estimate.missing = Missing::nothing;
        estimate.position_site_m = {filter_->state()(0), filter_->state()(1), tag_height_m};
        Eigen::Map<Eigen::Matrix<double, 6, 6>>(estimate.covariance.data()).topLeftCorner<2, 2>() =
            filter_->covariance().topLeftCorner<2, 2>();
        return estimate;
    }

  private:
    void move_to(double time_s) {
        filter_->predict(time_s - time_s_);
        time_s_ = time_s;
    }
    /// "When tracking fails UWB sets the vision's reference anew": scale and deflection begin as unknown as at first.
    void begin(const Eigen::Vector2d& flat_odometry, std::uint32_t segment) {
        segment_ = segment;
        began_odometry_ = flat_odometry;
        began_site_m_ = filter_->state().head<2>();
        vision::SixState::State again = filter_->state();
        again(vision::SixState::scale_at) = 1;
        again(vision::SixState::deflection_at) = 0;
        filter_.emplace(vision::SixStateModel{}, again, 0.3);
    }
    std::optional<vision::SixState> filter_;
    double time_s_ = 0;
    std::uint32_t segment_ = 0;
    Eigen::Vector2d began_odometry_ = Eigen::Vector2d::Zero(), began_site_m_ = Eigen::Vector2d::Zero();
};

/// The paper's filter is of the plane: it is told what is level in the vision's frame, turned by an angle that it must
/// find, which flatters it.
Eigen::Vector2d flat(const VisualOdometry& odometry, const SlamPath& slam) {
    const Eigen::Vector3d level = slam.odometry_from_site().conjugate() * vector(odometry.position_odometry);
    return Eigen::Rotation2Dd(2.0 * odometry.segment) * level.head<2>();
}

struct Results {
    Score letter, paper, uwb, fused;
    double largest_step_m = 0, largest_uwb_step_m = 0;
    double longest_alignment_s = 0;
    int segments = 0, aligned = 0;
};

Blocked behind(const Walker& walker) {
    return [&](const Eigen::Vector3d& tag_m, const Eigen::Vector3d& anchor_m, double time_s) {
        return (anchor_m - tag_m).normalized().dot(walker.direction(time_s)) < -0.5 ? blocked_longer_m : 0;
    };
}

/// From one published pose to the next, 20 ms later, in the plane.
class Steps {
  public:
    void add(const Estimate& estimate) {
        const Eigen::Vector2d here_m = vector(estimate.position_site_m).head<2>();
        if (has_begun_) largest_m = std::max(largest_m, (here_m - before_m_).norm());
        has_begun_ = true;
        before_m_ = here_m;
    }
    double largest_m = 0;

  private:
    bool has_begun_ = false;
    Eigen::Vector2d before_m_ = Eigen::Vector2d::Zero();
};

/// How long each segment takes to go into the pose.
class Alignments {
  public:
    void note(std::uint32_t segment, bool used, double time_s) {
        if (segment != segment_) {
            segment_ = segment;
            begun_s_ = time_s;
            ++segments;
            waits_ = true;
        }
        if (!waits_ || !used) return;
        waits_ = false;
        ++aligned;
        longest_s = std::max(longest_s, time_s - begun_s_);
    }
    int segments = 0, aligned = 0;
    double longest_s = 0;

  private:
    std::uint32_t segment_ = 0;
    double begun_s_ = 0;
    bool waits_ = false;
};

void walk(const Stage& stage, bool losses, bool blocked, unsigned seed, Results& results) {
    const Walker walker(stage.way);
    Radio radio(stage.site, {}, seed);
    SlamPath slam(seed + 100);
    const Blocked body = blocked ? behind(walker) : Blocked{};
    const auto letter = planar("range_ekf", stage.site, letter_of_the_paper());
    const auto uwb = planar("inertial_ekf", stage.site, InertialEkfSettings{});
    const auto fused = planar("visual_scale", stage.site, VisualScaleSettings{});
    PaperFilter paper;
    Steps steps, uwb_steps;
    Alignments alignments;
    for (int tick = 0; 0.02 * tick < stage.walked_s; ++tick) {
        const double time_s = 1 + 0.02 * tick;
        const Timestamp now = timestamp_from_s(time_s);
        const Eigen::Vector3d truth_m = walker.position_m(time_s);
        if (tick % 10 == 0) {
            for (const Measurement& m : ranges(stage.site, radio.hear(truth_m, time_s, body), time_s))
                for (const auto* each : {&letter, &uwb, &fused}) (*each)->update(m);
            paper.hear(letter->predict(now), time_s);
        }
        const bool lost = losses && std::ranges::any_of(stage.losses_s, [&](double from_s) {
                              return time_s > from_s && time_s < from_s + lost_s;
                          });
        const auto odometry = tick % 5 == 0 ? slam.see(truth_m, time_s, lost) : std::nullopt;
        if (odometry.has_value()) {
            const VisualOdometry& seen = odometry.value();
            const bool used = fused->update({now, 0, 1, seen}).reason == Exclusion::none;
            alignments.note(seen.segment, used, time_s);
            paper.see(flat(seen, slam), seen.segment, time_s);
        }
        if (time_s < first_scored_s) continue;
        const Estimate estimate = fused->predict(now), alone = uwb->predict(now);
        results.letter.add(letter->predict(now), truth_m);
        results.paper.add(paper.result(), truth_m);
        results.uwb.add(alone, truth_m);
        results.fused.add(estimate, truth_m);
        steps.add(estimate);
        uwb_steps.add(alone);
    }
    results.largest_step_m = std::max(results.largest_step_m, steps.largest_m);
    results.largest_uwb_step_m = std::max(results.largest_uwb_step_m, uwb_steps.largest_m);
    results.longest_alignment_s = std::max(results.longest_alignment_s, alignments.longest_s);
    results.segments += alignments.segments;
    results.aligned += alignments.aligned;
}

struct Trouble {
    const char* name;
    bool losses, body;
    double of_uwb; ///< RMSE of visual_scale, at most this share of inertial_ekf's
};
constexpr Trouble troubles[]{{"", false, false, 0.5},
                             {", two losses", true, false, 0.7},
                             {", a body", false, true, 0.7},
                             {", two losses, a body", true, true, 0.85}};

void print(const Stage& stage, const Trouble& trouble, const Results& r) {
    const auto less = [](const Score& fused, const Score& uwb) { return 100 * (fused.rmse_m() / uwb.rmse_m() - 1); };
    std::printf("| %s%s | %.2f -> %.2f | %.3f -> %.3f (%+.0f %%) | %.3f -> **%.3f** (%+.0f %%) | %.2f (%.2f) | %d of "
                "%d, %.1f s | "
                "%.2f (%.2f) |\n",
                stage.name, trouble.name, stage.paper_uwb_m, stage.paper_fused_m, r.letter.rmse_m(), r.paper.rmse_m(),
                less(r.paper, r.letter), r.uwb.rmse_m(), r.fused.rmse_m(), less(r.fused, r.uwb), r.fused.coverage(),
                r.uwb.coverage(), r.aligned, r.segments, r.longest_alignment_s, r.largest_step_m, r.largest_uwb_step_m);
}

TEST(Paper001Fusion, UwbAndMonocularSlam) {
    std::puts("| scene | paper RMSE m | six states: UWB -> fused | inertial_ekf -> visual_scale | within 95 % (UWB's) "
              "| aligned, "
              "longest | largest step m in 20 ms (UWB's) |");
    for (const Stage& stage : stages)
        for (const Trouble& trouble : troubles) {
            Results results;
            for (unsigned seed = 1; seed <= 10; ++seed) walk(stage, trouble.losses, trouble.body, seed, results);
            print(stage, trouble, results);
            const bool as_the_paper = !trouble.losses && !trouble.body;
            EXPECT_LE(as_the_paper ? results.fused.rmse_m() : 0, stage.paper_fused_m) << stage.name;
            EXPECT_LE(results.fused.rmse_m(), trouble.of_uwb * results.uwb.rmse_m()) << stage.name << trouble.name;
            EXPECT_EQ(results.aligned, results.segments) << stage.name << trouble.name;
            EXPECT_LE(results.longest_alignment_s, 3) << stage.name << trouble.name;
            EXPECT_LE(results.largest_step_m, 1.1 * results.largest_uwb_step_m) << stage.name << trouble.name;
        }
}

} // namespace
} // namespace locus::papers::scaled
