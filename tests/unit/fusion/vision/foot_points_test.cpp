// Feet that cameras see, through the engine: two people with tags and one without, on circles in a hall of 12 m x 8 m.
#include "fusion/engine.h"
#include "fusion/vision/anonymous.h"
#include "tests/allocations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace locus {
namespace {

/// Of a range, new each time, and as much as the default estimator expects to stay for a second (multipath, body).
constexpr double uwb_sigma_m = 0.1, held_sigma_m = 0.2, held_s = 1;
constexpr double feet_sigma_m = 0.15, tag_above_floor_m = 1.1;
constexpr Vec3 hall_corners[] = {{0, 0, 2.5}, {12, 0, 2.7}, {12, 8, 2.4}, {0, 8, 2.6}};

EngineSettings hall_settings() {
    EngineSettings settings;
    settings.cameras = 1;
    settings.fusion.max_targets = 8;
    settings.fusion.lost_after_s = 1;
    settings.targets = {{"anna", address(100), {}}, {"ben", address(101), {}}};
    for (std::uint64_t i = 0; i < 4; ++i) {
        Anchor anchor;
        anchor.name = "a" + std::to_string(i);
        anchor.address = address(i);
        anchor.position_site_m = hall_corners[i];
        settings.site.anchors.push_back(anchor);
    }
    return settings;
}

/// Person `who` at `time_s`: circles that meet.
Vec3 person_at(std::size_t who, double time_s) {
    const double angle = 2 * std::numbers::pi * time_s / 20 + 2.1 * static_cast<double>(who);
    return {6 + 3 * std::cos(angle) + 0.8 * static_cast<double>(who), 4 + 2.5 * std::sin(angle), tag_above_floor_m};
}

/// What the hall sends in a tenth of a second and what the engine makes of it.
class CameraHall {
  public:
    explicit CameraHall(const EngineSettings& settings) : engine(settings) {}

    void run(double from_s, double to_s) {
        for (double time_s = from_s; time_s < to_s - 1e-6; time_s += 0.1) step(time_s);
    }

    double error_m(std::size_t who) const {
        const Vec3 truth = person_at(who, now_s_);
        const auto& p = poses[who].estimate.position_site_m;
        return std::hypot(p[0] - truth[0], p[1] - truth[1]);
    }
    const Pose* anonymous() const {
        const auto found = std::ranges::find_if(poses, [](const Pose& p) { return vision::is_anonymous(p.target); });
        return found == poses.end() ? nullptr : &*found;
    }

    Engine engine;
    std::span<const Pose> poses;
    bool uwb = true, camera = true;
    std::array<std::uint32_t, 3> tracks{1, 2, 3};
    std::vector<double> errors_m;

  private:
    void step(double time_s) {
        for (std::uint64_t who = 0; who < 2 && uwb; ++who)
            for (std::uint64_t anchor = 0; anchor < 4; ++anchor) range(time_s + 0.02 * double(anchor), who, anchor);
        for (std::size_t who = 0; who < 3 && camera; ++who) see(time_s + 0.03, who);
        now_s_ = time_s + 0.1;
        poses = engine.step(timestamp_from_s(now_s_));
        for (std::size_t who = 0; who < 2; ++who) errors_m.push_back(error_m(who));
    }

    void range(double time_s, std::uint64_t who, std::uint64_t anchor) {
        const Vec3 tag = person_at(who, time_s), at = hall_corners[anchor];
        const double true_m = std::hypot(tag[0] - at[0], tag[1] - at[1], tag[2] - at[2]);
        double& held_m = held_m_[4 * who + anchor];
        const double keep = std::exp(-0.1 / held_s);
        held_m = keep * held_m + held_sigma_m * std::sqrt(1 - keep * keep) * normal_(random_);
        const Range range{address(anchor), address(100 + who), true_m + held_m + uwb_sigma_m * normal_(random_)};
        engine.submit({timestamp_from_s(time_s), ++sequence_, 0, range}, timestamp_from_s(time_s + 0.01));
    }

    void see(double time_s, std::size_t who) {
        const Vec3 at = person_at(who, time_s);
        const auto variance = static_cast<float>(feet_sigma_m * feet_sigma_m);
        FootPoint foot;
        foot.camera = address(0);
        foot.track = tracks[who];
        foot.position_site_m = {at[0] + feet_sigma_m * normal_(random_), at[1] + feet_sigma_m * normal_(random_)};
        foot.covariance_m2 = {variance, 0, variance};
        foot.looks[2 * who] = 200;
        engine.submit({timestamp_from_s(time_s), ++sequence_, 1, foot}, timestamp_from_s(time_s + 0.04));
    }

    std::mt19937 random_{5};
    std::normal_distribution<double> normal_{0, 1};
    std::array<double, 8> held_m_{};
    std::uint32_t sequence_ = 0;
    double now_s_ = 0;
};

TEST(FootPoints, FindTheirOwnersAndMakeThemSurer) {
    CameraHall both(hall_settings()), alone(hall_settings());
    alone.camera = false;
    both.run(10, 70);
    alone.run(10, 70);
    ASSERT_EQ(both.poses.size(), 2u);
    for (std::size_t who = 0; who < 2; ++who) {
        EXPECT_EQ(both.poses[who].seen_as.camera, address(0));
        EXPECT_EQ(both.poses[who].seen_as.track, who + 1);
        EXPECT_GT(both.poses[who].seen_as.confidence, 0.5F);
        EXPECT_EQ(alone.poses[who].seen_as.camera, no_address);
        EXPECT_LT(both.poses[who].horizontal_error_95_m, alone.poses[who].horizontal_error_95_m);
    }
    const auto mean = [](const std::vector<double>& errors) {
        return std::accumulate(errors.begin() + 40, errors.end(), 0.0) / static_cast<double>(errors.size() - 40);
    };
    EXPECT_LT(mean(both.errors_m), mean(alone.errors_m));
    EXPECT_GT(both.engine.counters().by_reason[static_cast<std::size_t>(Exclusion::nobody_known)], 500u)
        << "the third person has no tag";
}

TEST(FootPoints, CarryATargetWhoseTagFallsSilent) {
    CameraHall scene(hall_settings());
    scene.run(10, 20);
    scene.uwb = false;
    scene.errors_m.clear();
    scene.run(20, 24);
    EXPECT_LT(*std::ranges::max_element(scene.errors_m), 0.7);
    EXPECT_EQ(scene.poses[0].estimate.missing, Missing::nothing);
    EXPECT_EQ(scene.poses[0].seen_as.track, 1u);
}

TEST(FootPoints, GoToTheOtherWhenTheTrackerSwapsTwo) {
    CameraHall scene(hall_settings());
    scene.run(10, 20);
    std::swap(scene.tracks[0], scene.tracks[1]);
    scene.run(20, 23);
    EXPECT_EQ(scene.poses[0].seen_as.track, 2u);
    EXPECT_EQ(scene.poses[1].seen_as.track, 1u);
    EXPECT_LT(scene.error_m(0), 0.5);
}

TEST(FootPoints, OfPeopleWithoutATagAreTargetsWhereThatIsWanted) {
    EngineSettings settings = hall_settings();
    settings.vision.anonymous = true;
    settings.fusion.accept_unknown_targets = false;
    CameraHall scene(settings);
    scene.run(10, 20);
    const Pose* third = scene.anonymous();
    ASSERT_NE(third, nullptr);
    EXPECT_EQ(scene.poses.size(), 5u) << "until it is known who they are, the other two are people as well";
    EXPECT_EQ(scene.engine.target_name(third->target_index).substr(0, 12), "anonymous-1-");
    const auto placed =
        std::ranges::count_if(scene.poses, [](const Pose& pose) { return pose.estimate.missing == Missing::nothing; });
    EXPECT_EQ(placed, 3);
}

TEST(FootPoints, OfNoCameraOrTooLateAreRefused) {
    CameraHall scene(hall_settings());
    scene.run(10, 11);
    FootPoint foot;
    foot.camera = address(1);
    scene.engine.submit({timestamp_from_s(11), 1, 1, foot}, timestamp_from_s(11));
    foot.camera = address(0);
    scene.engine.submit({timestamp_from_s(10.85), 2, 1, foot}, timestamp_from_s(11));
    const auto& reasons = scene.engine.counters().by_reason;
    EXPECT_EQ(reasons[static_cast<std::size_t>(Exclusion::unknown_camera)], 1u);
    EXPECT_EQ(reasons[static_cast<std::size_t>(Exclusion::late)], 1u);
}

TEST(FootPoints, NeverAllocate) {
    for (const char* association : {"hungarian", "matrix"}) {
        EngineSettings settings = hall_settings();
        settings.vision.anonymous = true;
        settings.vision.association = association;
        settings.vision.looks_weight = 3;
        CameraHall scene(settings);
        scene.errors_m.reserve(1000);
        const test::AllocationCount count;
        scene.run(10, 20);
        EXPECT_EQ(count.made(), 0u) << association;
    }
}

TEST(FootPoints, FindTheirOwnersByTheMatrixToo) {
    EngineSettings settings = hall_settings();
    settings.vision.association = "matrix";
    settings.vision.near_m = 1; // the circles are closer than the 3 m of radios that are known to metres
    CameraHall scene(settings);
    scene.run(10, 40);
    for (std::size_t who = 0; who < 2; ++who) EXPECT_EQ(scene.poses[who].seen_as.track, who + 1);
    std::swap(scene.tracks[0], scene.tracks[1]);
    scene.run(40, 60);
    EXPECT_EQ(scene.poses[0].seen_as.track, 2u);
    EXPECT_EQ(scene.poses[1].seen_as.track, 1u);
}

} // namespace
} // namespace locus
