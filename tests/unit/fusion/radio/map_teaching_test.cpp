// Those whom a camera sees teach the radio map: who may, what is taken back, and what it is worth.
#include "fusion/engine.h"
#include "fusion/estimators/radio_grid.h"
#include "fusion/radio/calibrated_map.h"
#include "fusion/radio/teachers.h"
#include "tests/allocations.h"
#include "tests/unit/fusion/radio/radio_hall.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace locus {
namespace {

using radio::Lesson;
using radio::Teachers;
using test::RadioHall;

FootPoint feet_of_track(std::uint32_t track, double x_m) {
    FootPoint foot;
    foot.camera = address(0);
    foot.track = track;
    foot.position_site_m = {x_m, 2};
    foot.covariance_m2 = {0.01F, 0, 0.01F};
    return foot;
}

constexpr radio::Reading a_reading{address(100), -60};

/// Two people for so long: 0 is track 1, 1 is track 2, both are heard ten times a second.
std::size_t two_walk(Teachers& teachers, double from_s, double to_s, double confidence, double apart_m = 5) {
    std::size_t lessons = 0;
    const auto steps = static_cast<int>((to_s - from_s) * 10);
    for (int i = 0; i < steps; ++i) {
        const Timestamp time = timestamp_from_s(from_s + 0.1 * i);
        for (std::uint32_t person = 0; person < 2; ++person) {
            teachers.see(person, feet_of_track(person + 1, apart_m * person), confidence, time);
            teachers.hear(person, a_reading, time);
        }
        for (const Lesson& lesson : teachers.take()) lessons += !lesson.is_withdrawn;
    }
    return lessons;
}

TEST(MapTeachers, TeachOnceTheirNameHasBeenSureForAWhile) {
    Teachers teachers(2);
    EXPECT_EQ(two_walk(teachers, 0, 4.9, 1), 0U);
    EXPECT_GE(two_walk(teachers, 5, 6, 1), 18U);
    EXPECT_EQ(two_walk(teachers, 6, 7, 0.5), 0U) << "in doubt";
    EXPECT_EQ(two_walk(teachers, 7, 11.9, 1), 0U) << "sure anew";
}

TEST(MapTeachers, TeachNothingWhereOthersStandBesideThem) {
    Teachers teachers(2);
    EXPECT_EQ(two_walk(teachers, 0, 10, 1, 1), 0U);
}

TEST(MapTeachers, AreNotHeardWhereNobodySawThemJustNow) {
    Teachers teachers(2);
    two_walk(teachers, 0, 6, 1);
    teachers.hear(0, a_reading, timestamp_from_s(6.6));
    EXPECT_TRUE(teachers.take().empty());
}

TEST(MapTeachers, TakeBackWhatTheyTaughtUnderAnothersTrack) {
    Teachers teachers(2);
    two_walk(teachers, 0, 6, 1);
    teachers.hear(0, a_reading, timestamp_from_s(5.9));
    const std::uint64_t course = teachers.take()[0].course;
    teachers.see(1, feet_of_track(1, 0), 1, timestamp_from_s(6)); // track 1 is the other one's
    const auto lessons = teachers.take();
    ASSERT_EQ(lessons.size(), 1U);
    EXPECT_TRUE(lessons[0].is_withdrawn);
    EXPECT_EQ(lessons[0].course, course);
    teachers.hear(0, a_reading, timestamp_from_s(6));
    EXPECT_TRUE(teachers.take().empty()) << "his feet were not his";
}

TEST(MapTeachers, FlowOverWithoutHarm) {
    Teachers teachers(1);
    for (std::uint32_t track = 0; track < 1000; ++track) // more tracks than are remembered
        teachers.see(0, feet_of_track(track, 0), 1, timestamp_from_s(0.01 * track));
    for (int i = 0; i < 60; ++i) teachers.see(0, feet_of_track(999, 0), 1, timestamp_from_s(10 + 0.1 * i));
    const test::AllocationCount count;
    for (std::size_t i = 0; i < 2 * Teachers::max_lessons; ++i) teachers.hear(0, a_reading, timestamp_from_s(16));
    EXPECT_EQ(count.made(), 0U);
    EXPECT_EQ(teachers.take().size(), Teachers::max_lessons);
    EXPECT_TRUE(teachers.take().empty());
}

/// A tag that is known by its ranges, the feet of track 7 at the same place, and a beacon that it hears.
TEST(MapTeaching, ComesOutOfTheEngine) {
    EngineSettings settings;
    settings.fusion.estimator = "chan_taylor";
    settings.cameras = 1;
    const Vec3 tag_m{3, 4, 1};
    for (unsigned i = 0; i < 6; ++i)
        settings.site.anchors.push_back({"", address(i + 1), {(i & 1) * 10.0, (i >> 1 & 1) * 8.0, (i >> 2) * 3.0}});
    Engine engine(settings);
    std::size_t lessons = 0;
    for (std::uint32_t i = 0; i < 80; ++i) {
        const Timestamp time = timestamp_from_s(0.1 * i);
        const auto submit = [&](const Observation& observation) { engine.submit({time, i, 0, observation}, time); };
        for (const Anchor& anchor : settings.site.anchors) {
            const Vec3& at = anchor.position_site_m;
            const double range_m = std::hypot(at[0] - tag_m[0], at[1] - tag_m[1], at[2] - tag_m[2]);
            submit(Range{.anchor = anchor.address, .tag = address(50), .range_m = range_m});
        }
        FootPoint foot = feet_of_track(7, tag_m[0]);
        foot.position_site_m[1] = tag_m[1];
        submit(foot);
        submit(SignalStrength{address(900), address(50), -63});
        engine.step(time + duration_from_s(0.05));
        for (const Lesson& lesson : engine.take_lessons()) {
            ++lessons;
            EXPECT_GT(i, 50U);
            EXPECT_FALSE(lesson.is_withdrawn);
            EXPECT_EQ(lesson.reading.beacon, address(900));
            EXPECT_EQ(lesson.reading.rssi_dbm, -63);
            EXPECT_EQ(lesson.position_site_m[0], 3);
            EXPECT_EQ(lesson.position_site_m[1], 4);
        }
    }
    EXPECT_GT(lessons, 15U);
}

/// Since the survey two beacons have been hung elsewhere in their cases and send 8 dB less.
test::SimulatedRadios rebuilt(unsigned seed, bool is_rebuilt) {
    test::SimulatedRadios radios(test::hall_beacons(), seed);
    if (is_rebuilt) radios.weaker_db = {8, 0, 0, 8, 0, 0};
    return radios;
}

/// Somebody walks ten minutes in view of a camera; then somebody else whom nobody sees.
TEST(MapTeaching, MakesPlacesBetterWhereTheWorldHasChanged) {
    double stale_m = 0, taught_m = 0;
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const radio::RadioMap survey = rebuilt(seed, false).survey(20, 12, 2);
        radio::CalibratedMap map(survey, {});
        RadioHall seen(false, seed, false, rebuilt(seed, true));
        for (int i = 0; i < 600; ++i) {
            seen.walk(1, false);
            const Eigen::Vector2d at = seen.walker.position_m().head<2>();
            map.learn(1, at, seen.radios.hear(at));
        }
        RadioHall stale(survey, seed + 10, rebuilt(seed, true)), taught(map.map(), seed + 10, rebuilt(seed, true));
        stale.walk(100);
        taught.walk(100);
        stale_m += stale.mean_m() / 3;
        taught_m += taught.mean_m() / 3;
    }
    std::printf("unseen, by the survey %.2f m, by the map that was taught %.2f m\n", stale_m, taught_m);
    EXPECT_LT(taught_m, 0.9 * stale_m);
}

/// Estimators read what was put in place of the grid that they were made with.
TEST(MapTeaching, AnotherGridComesIntoUseInPlaceOfTheOld) {
    RadioParticlesSettings settings;
    auto map = std::make_shared<radio::RadioMap>(rebuilt(1, false).survey(20, 12, 2));
    settings.radio_map = map;
    settings.grid = std::make_shared<radio::GridInUse>();
    const RadioParticles filter({}, settings);
    for (auto& point : map->points)
        for (auto& strength : point.heard) strength.mean_dbm += 5;
    const float before = settings.grid->grid().at(0, 10, 6).mean_dbm;
    auto next = map_grid(*map, settings.lost_share);
    EXPECT_TRUE(settings.grid->exchange(next));
    EXPECT_NEAR(settings.grid->grid().at(0, 10, 6).mean_dbm, before + 5, 1);
    EXPECT_NEAR(next->at(0, 10, 6).mean_dbm, before, 1e-3);
    map->points.resize(12);
    auto other = map_grid(*map, settings.lost_share);
    EXPECT_FALSE(settings.grid->exchange(other)) << "of other places";
}

} // namespace
} // namespace locus
