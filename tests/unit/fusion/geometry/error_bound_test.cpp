#include "fusion/geometry/error_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace locus {
namespace {

/// Probability that a normal error with these axes lies within the radius: integral over the angle in the plane where
/// the ellipse is a circle. Axes in m.
double probability_within(double radius_m, double longer_m, double shorter_m) {
    constexpr int steps = 400;
    double outside = 0;
    for (int i = 0; i < steps; ++i) {
        const double angle = (i + 0.5) / steps * std::numbers::pi / 2;
        const double x = longer_m * std::cos(angle), y = shorter_m * std::sin(angle);
        outside += std::exp(-0.5 * radius_m * radius_m / (x * x + y * y)) / steps;
    }
    return 1 - outside;
}

double exact_radius_m(double longer_m, double shorter_m) {
    double low = 0, high = 3 * longer_m;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (probability_within(middle, longer_m, shorter_m) < 0.95 ? low : high) = middle;
    }
    return low;
}

TEST(ErrorBound, CircleIsExactWithinHalfAPercentForAllAxisRatiosAndDirections) {
    for (int share = 0; share <= 50; ++share) {
        const double longer_m = 0.3, shorter_m = longer_m * share / 50;
        const double expected_m = exact_radius_m(longer_m, shorter_m);
        for (const double angle : {0.0, 0.3, 1.2, 2.5}) {
            const double c = std::cos(angle), s = std::sin(angle);
            const double a = longer_m * longer_m, b = shorter_m * shorter_m;
            EXPECT_NEAR(horizontal_error_95_m(c * c * a + s * s * b, c * s * (a - b), s * s * a + c * c * b),
                        expected_m, 0.005 * expected_m)
                << "axis ratio " << share / 50.0 << " at " << angle;
        }
    }
}

TEST(ErrorBound, VerticalIsTheTwoSidedQuantileOfOneAxis) { EXPECT_NEAR(vertical_error_95_m(0.25), 0.98, 0.0001); }

TEST(ErrorBound, ZeroAndRoundedBelowZeroAreZeroAndNaNStaysNaN) {
    EXPECT_EQ(horizontal_error_95_m(0, 0, 0), 0);
    EXPECT_EQ(horizontal_error_95_m(-1e-18, 0, -1e-18), 0);
    EXPECT_EQ(vertical_error_95_m(-1e-18), 0);
    EXPECT_TRUE(std::isnan(horizontal_error_95_m(std::nan(""), 0, 1)));
    EXPECT_TRUE(std::isnan(vertical_error_95_m(std::nan(""))));
}

} // namespace
} // namespace locus
