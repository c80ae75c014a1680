// Anchors judged: which one is bad, what ails it and where it stands, through the whole engine. Seeds are 1 to n.
#include "fusion/uwb/leave_one_out.h"
#include "tests/allocations.h"
#include "tests/support/sanitizer.h"
#include "tests/unit/fusion/anchor_world.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cstdio>

namespace locus::anchor_test {
namespace {

using test::AnchorWorld;
using test::AnchorWorldSettings;

constexpr std::size_t bad_one = 2;

bool is_well(AnchorState state) {
    return state == AnchorState::good || state == AnchorState::joined || state == AnchorState::not_heard;
}

AnchorWorldSettings world_of(std::size_t anchors, unsigned seed) {
    AnchorWorldSettings settings;
    settings.anchors = anchors;
    settings.seed = seed;
    return settings;
}

void run(AnchorWorld& world, int sweeps) {
    for (int i = 0; i < sweeps; ++i) world.sweep();
}

int count_bad(const AnchorWorld& world, std::size_t anchors, std::size_t but) {
    int bad = 0;
    for (std::size_t i = 0; i < anchors; ++i) bad += i != but && !is_well(world.state(i));
    return bad;
}

// ---- one epoch

/// What a tag at `truth_m` would hear without noise, seen from a metre beside it.
std::vector<uwb::SightLine> clean_epoch(const Site& site, bool differences) {
    const Eigen::Vector3d truth_m(5, 4, 1.5);
    std::vector<uwb::SightLine> lines;
    const auto n = static_cast<std::int16_t>(site.anchors.size());
    for (std::int16_t i = 0; i < n; ++i) {
        uwb::Sighting sighting{i, differences ? static_cast<std::int16_t>((i + n - 1) % n) : uwb::Sighting::nobody};
        sighting.value_m = uwb::predicted_m(sighting, site, truth_m);
        lines.push_back({sighting, truth_m + Eigen::Vector3d(0.01, -0.02, 0.01)});
    }
    return lines;
}

TEST(LeaveOneOut, GivesTheErrorOfAnAnchorFromRangesAndFromDifferences) {
    const Site site = test::anchored_hall(8);
    for (const bool differences : {false, true}) {
        std::vector<uwb::SightLine> lines = clean_epoch(site, differences);
        for (uwb::SightLine& line : lines)
            line.sighting.value_m += line.sighting.plus == 3 ? 0.7 : line.sighting.minus == 3 ? -0.7 : 0;
        const uwb::EpochPrior prior{{100, 100, 100}, 0, 0};
        const uwb::LeaveOneOut without(site, lines, prior, {});
        const std::array<std::int16_t, 1> doubt{3};
        const uwb::LeaveOneOut with(site, lines, prior, doubt);
        for (const uwb::LeaveOneOut* test : {&without, &with}) {
            const uwb::AnchorError error = test->error_of(3);
            EXPECT_NEAR(error.pull / error.information, 0.7, 0.01) << differences;
        }
        EXPECT_NEAR(with.error_of(5).pull / with.error_of(5).information, 0, 0.01);
        EXPECT_GT(std::abs(without.error_of(5).pull / without.error_of(5).information), 0.05)
            << "the bad one spoils the others until it is in doubt";
        EXPECT_NEAR(without.error_of(3).information, with.error_of(3).information, 1e-6 * with.error_of(3).information);
    }
}

// ---- found and named

struct Named {
    int right = 0, wrong = 0, sweeps = 0;
};

/// A path that becomes a metre too long after half a minute.
Named name_the_blocked(std::size_t anchors, bool differences, unsigned seeds, int within_sweeps, bool planar = false) {
    Named named;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        AnchorWorldSettings settings = world_of(anchors, seed);
        settings.differences = differences;
        settings.planar = planar;
        AnchorWorld world(settings);
        run(world, 300);
        world.longer_m = [](std::size_t anchor, int) { return anchor == bad_one ? 1.0 : 0.0; };
        int sweeps = 0;
        while (sweeps < within_sweeps && is_well(world.state(bad_one))) run(world, 1), ++sweeps;
        named.right += !is_well(world.state(bad_one));
        named.sweeps += sweeps;
        run(world, 100);
        named.wrong += count_bad(world, anchors, bad_one);
    }
    std::printf("%zu anchors, %s: named in %d of %u runs, after %.0f epochs; others named %d\n", anchors,
                differences ? "differences" : "ranges", named.right, seeds, static_cast<double>(named.sweeps) / seeds,
                named.wrong);
    return named;
}

// Issue 4: one bad anchor among five is found and named. In the plane five leave two to spare, and in 40 runs 38 must
// be right within half a minute; measured: all.
TEST(AnchorHealth, NamesTheBadOneAmongFiveInThePlane) {
    const Named named = name_the_blocked(5, false, 40, 300, true);
    EXPECT_GE(named.right, 38);
    EXPECT_LE(named.wrong, 1);
}

// In space five is the least that can tell at all, and where the tag walks the error of one may look much like that of
// another: not all are found, but a wrong one is seldom named. Measured: 32 of 40, 2 wrong ones.
TEST(AnchorHealth, NamesTheBadOneAmongFiveInSpaceMostly) {
    const Named named = name_the_blocked(5, false, 40, 300);
    EXPECT_GE(named.right, 26);
    EXPECT_LE(named.wrong, 4);
}

// A difference holds the errors of two anchors: a minute.
TEST(AnchorHealth, NamesTheRightOneOfThePairsOfRangeDifferences) {
    const Named named = name_the_blocked(8, true, 20, 600);
    EXPECT_GE(named.right, 19);
    EXPECT_LE(named.wrong, 1);
    EXPECT_EQ(name_the_blocked(6, true, 20, 600).wrong, 0) << "the least that can tell";
}

// 10^5 epochs of good anchors whose noise is what the settings say: at most one of them called bad.
TEST(AnchorHealth, SeldomCallsAGoodAnchorBad) {
    AnchorWorldSettings settings = world_of(5, 1);
    settings.tags = 5;
    AnchorWorld world(settings);
    std::vector<bool> was(settings.anchors);
    int alarms = 0;
    const int sweeps = test::under_sanitizer ? 2000 : 20000;
    for (int i = 0; i < sweeps; ++i) {
        world.sweep();
        for (std::size_t anchor = 0; anchor < settings.anchors; ++anchor) {
            const bool bad = !is_well(world.state(anchor));
            alarms += bad && !was[anchor];
            was[anchor] = bad;
        }
    }
    std::printf("%d alarms in %d epochs\n", alarms, sweeps * settings.tags);
    EXPECT_LE(alarms, 1);
    EXPECT_EQ(world.state(0), AnchorState::good);
}

TEST(AnchorHealth, BlockedPathIsCalledSoAndIsWellAgainAfterwards) {
    AnchorWorld world(world_of(8, 1));
    run(world, 300);
    world.longer_m = [](std::size_t anchor, int) { return anchor == bad_one ? 1.2 : 0.0; };
    run(world, 600);
    EXPECT_EQ(world.state(bad_one), AnchorState::blocked);
    EXPECT_NEAR(world.report(bad_one).residual_m, 1.2, 0.2);
    EXPECT_EQ(count_bad(world, 8, bad_one), 0);
    world.longer_m = [](std::size_t, int) { return 0.0; };
    run(world, 3000);
    EXPECT_EQ(world.state(bad_one), AnchorState::good);
}

// ---- moved

struct Place {
    int found = 0, inside = 0, wrong = 0;
    double squares_m2 = 0;
};

void compare(const AnchorReport& report, const Eigen::Vector3d& truth_m, Place& place) {
    if (!std::isfinite(report.stands_site_m[0]) || !std::isfinite(report.stands_site_m[1])) return;
    const auto& c = report.stands_covariance_m2;
    const Eigen::Matrix2d covariance = (Eigen::Matrix2d() << c[0], c[1], c[1], c[3]).finished();
    const Eigen::Vector2d error(report.stands_site_m[0] - truth_m.x(), report.stands_site_m[1] - truth_m.y());
    constexpr double ellipse_95 = 5.991; // chi-square of two degrees of freedom
    ++place.found;
    place.inside += error.dot(covariance.inverse() * error) < ellipse_95;
    place.squares_m2 += error.squaredNorm();
}

Place place_of_moved(std::size_t anchors, bool differences, unsigned seeds) {
    Place place;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        AnchorWorldSettings settings = world_of(anchors, seed);
        settings.differences = differences;
        AnchorWorld world(settings);
        run(world, 300);
        std::mt19937 random(seed + 50);
        std::normal_distribution<double> normal;
        Eigen::Vector3d by_m(normal(random), normal(random), 0.4 * normal(random));
        by_m *= 1.2 / by_m.norm();
        const std::size_t anchor = seed % anchors;
        world.move_anchor(anchor, by_m);
        run(world, 1200);
        compare(world.report(anchor), world.stands_m(anchor), place);
        place.wrong += count_bad(world, anchors, anchor);
    }
    std::printf("%zu anchors, %s: moved one placed in %d of %u runs, RMSE %.2f m, in its ellipse %d; others named %d\n",
                anchors, differences ? "differences" : "ranges", place.found, seeds,
                std::sqrt(place.squares_m2 / std::max(1, place.found)), place.inside, place.wrong);
    return place;
}

// Two minutes after an anchor was moved by 1.2 m, one tag walking: its place, within the 95 % ellipse in 90 of 100.
// By differences not every place has been seen from enough sides by then.
TEST(AnchorHealth, TellsWhereAMovedAnchorStandsNow) {
    for (const bool differences : {false, true}) {
        const Place place = place_of_moved(8, differences, 30);
        EXPECT_GE(place.found, differences ? 8 : 18);
        EXPECT_GE(place.inside, 0.9 * place.found);
        EXPECT_EQ(place.wrong, 0);
    }
}

// ---- comes and goes

TEST(AnchorHealth, SeesAnAnchorFallSilentAndComeBackAndJoin) {
    AnchorWorld world(world_of(8, 1));
    world.silence(3, true);
    run(world, 100);
    EXPECT_EQ(world.state(3), AnchorState::not_heard);
    EXPECT_EQ(world.state(4), AnchorState::good);
    world.silence(3, false);
    run(world, 12);
    EXPECT_EQ(world.state(3), AnchorState::joined);
    run(world, 60);
    EXPECT_EQ(world.state(3), AnchorState::good);
    world.silence(4, true);
    run(world, 80);
    EXPECT_EQ(world.state(4), AnchorState::silent);
    EXPECT_NEAR(to_s(world.report(4).since), world.time_s() - 2, 2);
    world.silence(4, false);
    run(world, 80);
    EXPECT_EQ(world.state(4), AnchorState::good);
}

TEST(AnchorHealth, AllocatesNothing) {
    for (const bool differences : {false, true}) {
        AnchorWorldSettings settings = world_of(8, 1);
        settings.differences = differences;
        settings.tags = 2;
        AnchorWorld world(settings);
        world.move_anchor(bad_one, {1, 1, 0});
        world.longer_m = [](std::size_t anchor, int) { return anchor == 5 ? 1.0 : 0.0; };
        const test::AllocationCount count;
        run(world, 1000);
        EXPECT_EQ(count.made(), 0U);
        EXPECT_FALSE(is_well(world.state(bad_one)));
    }
}

} // namespace
} // namespace locus::anchor_test
