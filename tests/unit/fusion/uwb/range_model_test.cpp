#include "fusion/uwb/range_model.h"

#include "tests/unit/fusion/jacobian.h"

#include <gtest/gtest.h>

#include <random>

namespace locus::uwb {
namespace {

using Eigen::Vector3d;
using test::jacobian_matches;

const Vector3d anchor_a{0, 0, 2.8};
const Vector3d anchor_b{10, 8, 0.2};

auto range_to_a = [](const Vector3d& x) { return range(x, anchor_a); };
auto difference_a_b = [](const Vector3d& x) { return range_difference(x, anchor_a, anchor_b); };

TEST(RangeModel, DifferenceIsLongerFromBLessFromA) {
    EXPECT_DOUBLE_EQ(range(Vector3d{3, 4, 0}, Vector3d::Zero()), 5);
    EXPECT_DOUBLE_EQ(range_difference(Vector3d{1, 0, 0}, Vector3d{0, 0, 0}, Vector3d{4, 0, 0}), 2);
}

TEST(RangeModel, GradientsMatchDifferencesInAndAroundTheHall) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> coordinate(-30, 30);
    for (int i = 0; i < 1000; ++i) {
        const Vector3d x{coordinate(random), coordinate(random), coordinate(random)};
        ASSERT_TRUE(jacobian_matches(range_to_a, range_gradient(x, anchor_a).transpose(), x));
        ASSERT_TRUE(jacobian_matches(difference_a_b, range_difference_gradient(x, anchor_a, anchor_b).transpose(), x));
    }
}

TEST(RangeModel, GradientsHoldAtDegeneratePoints) {
    const Vector3d beyond_b = anchor_b + 100 * (anchor_b - anchor_a);
    const Vector3d between = 0.5 * (anchor_a + anchor_b);
    for (const Vector3d& x : {anchor_a, anchor_b, beyond_b, between, Vector3d{anchor_a + Vector3d{1e-3, 0, 0}}}) {
        EXPECT_TRUE(jacobian_matches(range_to_a, range_gradient(x, anchor_a).transpose(), x, 1e-5));
        EXPECT_TRUE(
            jacobian_matches(difference_a_b, range_difference_gradient(x, anchor_a, anchor_b).transpose(), x, 1e-5));
    }
}

TEST(RangeModel, OnTheAnchorTheGradientIsZero) { EXPECT_EQ(range_gradient(anchor_a, anchor_a), Vector3d::Zero()); }

TEST(Jacobian, HarnessRefusesAWrongGradient) {
    const Vector3d x{1, 2, 3};
    EXPECT_FALSE(jacobian_matches(range_to_a, -range_gradient(x, anchor_a).transpose(), x));
    EXPECT_FALSE(jacobian_matches(range_to_a, range_gradient(x, anchor_a), x)) << "column where a row is due";
}

} // namespace
} // namespace locus::uwb
