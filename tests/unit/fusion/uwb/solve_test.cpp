// What the solvers promise without noise, and what they refuse.
#include "fusion/uwb/solve.h"

#include "tests/unit/fusion/uwb/hall.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

namespace locus::uwb::test {
namespace {

constexpr double nan_m = std::numeric_limits<double>::quiet_NaN();

SolveSettings planar(double height_m = 0) {
    SolveSettings settings;
    settings.planar = true;
    settings.height_site_m = height_m;
    return settings;
}

double error_m(const Fix& fix, const Vector3d& tag) { return (vector(fix.position_site_m) - tag).norm(); }

// ---- Degenerate geometry: name, anchors, tag, planar, what ranges and what differences against the first answer.

struct Degenerate {
    const char* name;
    Anchors anchors;
    Vector3d tag;
    bool planar;
    Exclusion of_ranges;
    Exclusion of_differences;
};
void PrintTo(const Degenerate& d, std::ostream* out) { *out << d.name; }

constexpr auto used = Exclusion::none;
constexpr auto too_few = Exclusion::geometry_too_few;
constexpr auto degenerate = Exclusion::geometry_degenerate;
constexpr auto mirror = Exclusion::geometry_mirror;

const Anchors corridor{{0, 0, 2}, {5, 0, 2}, {10, 0, 2}, {15, 0, 2}, {20, 0, 2}};
const Anchors twice_the_same{{0, 0, 0}, {0, 0, 0}, {10, 0, 0}, {10, 0, 0}};
const Anchors wavy_ceiling{{0, 0, 2.80}, {10, 0, 2.81}, {10, 8, 2.80}, {0, 8, 2.81}, {5, 4, 2.83}};

class SolveDegenerate : public testing::TestWithParam<Degenerate> {};

TEST_P(SolveDegenerate, IsRefusedWithItsReasonOrSolved) {
    const Degenerate& d = GetParam();
    const SolveSettings settings = d.planar ? planar(d.tag.z()) : SolveSettings{};
    const Fix by_ranges = solve_ranges(ranges_from(d.tag, d.anchors), settings);
    EXPECT_EQ(exclusion_name(by_ranges.reason), exclusion_name(d.of_ranges));
    const Fix by_differences =
        solve_differences(differences_from(d.tag, d.anchors, against_first(d.anchors)), settings);
    EXPECT_EQ(exclusion_name(by_differences.reason), exclusion_name(d.of_differences));
    if (by_ranges.reason == used) {
        EXPECT_LT(error_m(by_ranges, d.tag), 1e-3);
    }
    if (by_differences.reason == used) {
        EXPECT_LT(error_m(by_differences, d.tag), 1e-3);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Geometries, SolveDegenerate,
    testing::Values(
        Degenerate{"no_anchor", {}, {1, 1, 1}, false, too_few, too_few},
        Degenerate{"three_in_space", Anchors(box.begin(), box.begin() + 3), {4, 3, 1}, false, too_few, too_few},
        Degenerate{"two_in_the_plane", Anchors(box.begin(), box.begin() + 2), {4, 3, 0}, true, too_few, too_few},
        Degenerate{"the_same_anchor_twice", twice_the_same, {4, 3, 0}, true, too_few, too_few},
        Degenerate{"corridor_in_space", corridor, {7, 2, 1}, false, degenerate, degenerate},
        Degenerate{"corridor_in_the_plane", corridor, {7, 2, 1}, true, mirror, mirror},
        Degenerate{"corridor_on_its_line", corridor, {7, 0, 1}, true, mirror, mirror},
        Degenerate{"ceiling", ceiling, {4, 3, 1}, false, mirror, mirror},
        Degenerate{"ceiling_in_the_plane", ceiling, {4, 3, 1}, true, used, used},
        Degenerate{"ceiling_not_quite_flat", wavy_ceiling, {4, 3, 1}, false, mirror, mirror},
        Degenerate{"on_an_anchor", box, box[2], false, used, used},
        Degenerate{"on_an_anchor_in_the_plane", rectangle, rectangle[1], true, used, used},
        Degenerate{"a_little_outside", box, {12, 4, 1}, false, used, used},
        Degenerate{"far_outside", box, {500, 300, 1}, false, degenerate, degenerate}),
    testing::PrintToStringParamName());

// ---- Input that no geometry can save.

TEST(Solve, RefusesWhatIsNotFinite) {
    const std::vector<RangeTo> good = ranges_from({4, 3, 1}, box);
    for (const double wrong : {nan_m, std::numeric_limits<double>::infinity()}) {
        auto ranges = good;
        ranges[3].range_m = wrong;
        EXPECT_EQ(solve_ranges(ranges, {}).reason, Exclusion::not_finite);
        ranges = good;
        ranges[3].anchor_site_m[1] = wrong;
        EXPECT_EQ(solve_ranges(ranges, {}).reason, Exclusion::not_finite);
        ranges = good;
        ranges[3].sigma_m = wrong;
        EXPECT_EQ(solve_ranges(ranges, {}).reason, Exclusion::not_finite);
        EXPECT_EQ(solve_ranges(good, planar(wrong)).reason, Exclusion::not_finite);
    }
    for (const double bad_sigma_m : {0.0, -0.1}) {
        auto ranges = good;
        ranges[0].sigma_m = bad_sigma_m;
        EXPECT_EQ(solve_ranges(ranges, {}).reason, Exclusion::not_finite);
    }
}

TEST(Solve, AbsurdButFiniteNumbersGiveAReasonOrFiniteNumbers) {
    for (const double absurd : {1e300, -1e300, 1e160, 1e-300}) {
        auto ranges = ranges_from({4, 3, 1}, box);
        ranges[1].range_m = absurd;
        ranges[2].sigma_m = std::abs(absurd);
        const Fix fix = solve_ranges(ranges, {});
        if (fix.reason == used) {
            EXPECT_TRUE(vector(fix.position_site_m).allFinite());
        }
        ranges[3].anchor_site_m[0] = absurd;
        const Fix moved = solve_ranges(ranges, {});
        if (moved.reason == used) {
            EXPECT_TRUE(vector(moved.position_site_m).allFinite());
        }
    }
}

TEST(Solve, LooksAtNoMoreThanSixtyFour) {
    std::vector<RangeTo> ranges;
    while (ranges.size() < max_observations)
        for (const RangeTo& range : ranges_from({4, 3, 1}, box)) ranges.push_back(range);
    ranges.push_back({{0, 0, 0}, nan_m, 0.1});
    const Fix fix = solve_ranges(ranges, {});
    EXPECT_EQ(fix.reason, used);
    EXPECT_EQ(fix.degrees_of_freedom, 61);
}

TEST(Solve, PairsThatDoNotHangTogetherAreSolvedWithoutChan) {
    const Vector3d tag{4, 3, 1.2};
    const Fix fix = solve_differences(differences_from(tag, box, {{0, 1}, {2, 3}, {4, 5}, {6, 7}}), {});
    ASSERT_EQ(fix.reason, used);
    EXPECT_LT(error_m(fix, tag), 1e-4);
}

TEST(Solve, ChainOfSixtyFourPairs) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> coordinate(-20, 20);
    Anchors anchors;
    Pairs chain;
    for (int i = 0; i <= 64; ++i) {
        anchors.emplace_back(coordinate(random), coordinate(random), coordinate(random));
        if (i > 0) chain.emplace_back(i - 1, i);
    }
    const Vector3d tag{3, -4, 5};
    const Fix fix = solve_differences(differences_from(tag, anchors, chain), {});
    ASSERT_EQ(fix.reason, used);
    EXPECT_LT(error_m(fix, tag), 1e-4);
}

TEST(Solve, MorePrecisePairsCountMore) {
    auto ranges = ranges_from({4, 3, 0}, rectangle);
    ranges[0].range_m += 1;
    ranges[0].sigma_m = 1000;
    const Fix fix = solve_ranges(ranges, planar());
    ASSERT_EQ(fix.reason, used);
    EXPECT_LT(error_m(fix, {4, 3, 0}), 1e-4);
}

// ---- Properties.

/// Box corners, each moved by up to 1.5 m, so never flat; the tag inside.
struct Hall {
    Anchors anchors;
    Vector3d tag;
};
Hall random_hall() {
    const auto number = [](int limit_mm) { return 0.001 * *rc::gen::inRange(-limit_mm, limit_mm); };
    Hall hall;
    for (const Vector3d& corner : box)
        hall.anchors.push_back(2 * corner + Vector3d{number(1500), number(1500), number(500)});
    hall.tag = Vector3d{10, 8, 3} + Vector3d{number(7000), number(5000), number(1500)};
    return hall;
}

RC_GTEST_PROP(SolveProperty, ExactMeasurementsGiveTheExactPoint, ()) {
    const Hall hall = random_hall();
    const Pairs pairs = *rc::gen::arbitrary<bool>() ? against_first(hall.anchors) : round_robin(hall.anchors);
    const Fix by_ranges = solve_ranges(ranges_from(hall.tag, hall.anchors), {});
    const Fix by_differences = solve_differences(differences_from(hall.tag, hall.anchors, pairs), {});
    RC_ASSERT(by_ranges.reason == used);
    RC_ASSERT(by_differences.reason == used);
    RC_ASSERT(error_m(by_ranges, hall.tag) < 1e-4);
    RC_ASSERT(error_m(by_differences, hall.tag) < 1e-4);
}

RC_GTEST_PROP(SolveProperty, MovingTheSiteMovesTheFixAndItsCovariance, ()) {
    const Hall hall = random_hall();
    const double angle = 0.001 * *rc::gen::inRange(-3142, 3142);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Vector3d{1, 2, 3}.normalized()).toRotationMatrix();
    const Vector3d shift{*rc::gen::inRange(-500000, 500000) * 1.0, *rc::gen::inRange(-500000, 500000) * 1.0, 100};
    auto here = differences_from(hall.tag, hall.anchors, round_robin(hall.anchors));
    for (DifferenceOf& d : here) d.difference_m += 0.0001 * *rc::gen::inRange(-2000, 2000);
    auto there = here;
    for (DifferenceOf& d : there) {
        d.anchor_a_site_m = array(turn * vector(d.anchor_a_site_m) + shift);
        d.anchor_b_site_m = array(turn * vector(d.anchor_b_site_m) + shift);
    }
    const Fix fix = solve_differences(here, {}), moved = solve_differences(there, {});
    RC_ASSERT(fix.reason == used);
    RC_ASSERT(moved.reason == used);
    // Rotation changes Chan's point, so the last hundredth of a standard deviation may differ.
    RC_ASSERT((turn * vector(fix.position_site_m) + shift - vector(moved.position_site_m)).norm() < 5e-3);
    const Eigen::Matrix3d covariance = Eigen::Map<const Eigen::Matrix3d>(fix.covariance_m2.data());
    const Eigen::Matrix3d expected = turn * covariance * turn.transpose();
    RC_ASSERT((expected - Eigen::Map<const Eigen::Matrix3d>(moved.covariance_m2.data())).norm() <
              0.05 * expected.norm());
}

} // namespace
} // namespace locus::uwb::test
