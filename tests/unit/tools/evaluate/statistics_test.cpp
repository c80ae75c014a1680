// The figures against cases worked out by hand, and laws that hold for any errors.
#include "tools/evaluate/statistics.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace locus::evaluate {
namespace {

Pair pair(const Eigen::Vector3d& error_m, double horizontal_bound_m = no_bound, double vertical_bound_m = no_bound) {
    const Eigen::Vector3d truth_m(10, 20, 30);
    return {0, truth_m, truth_m + error_m, horizontal_bound_m, vertical_bound_m};
}

TEST(Figures, OfErrorsWorkedOutByHand) {
    const Figures f = figures({4, 1, 3, 2, 0});
    EXPECT_DOUBLE_EQ(f.rmse_m, std::sqrt(6.0));
    EXPECT_DOUBLE_EQ(f.mean_m, 2);
    EXPECT_DOUBLE_EQ(f.median_m, 2);
    EXPECT_DOUBLE_EQ(f.p80_m, 3.2);
    EXPECT_DOUBLE_EQ(f.p95_m, 3.8);
    EXPECT_DOUBLE_EQ(f.max_m, 4);
}

TEST(Figures, OfOneErrorAreThatError) {
    const Figures f = figures({0.5});
    for (const double value : {f.rmse_m, f.mean_m, f.median_m, f.p80_m, f.p95_m, f.max_m}) EXPECT_EQ(value, 0.5);
}

TEST(Figures, KeepTheirOrderScaleWithTheErrorsAndForgetTheOrderOfTime) {
    EXPECT_TRUE(rc::check([](unsigned seed) {
        std::mt19937 random(seed);
        std::exponential_distribution<double> error(3);
        std::vector<double> errors(1 + random() % 100);
        std::ranges::generate(errors, [&] { return error(random); });
        const Figures f = figures(errors);
        RC_ASSERT(f.median_m <= f.p80_m && f.p80_m <= f.p95_m && f.p95_m <= f.max_m);
        RC_ASSERT(f.mean_m <= f.rmse_m * (1 + 1e-12) && f.rmse_m <= f.max_m * (1 + 1e-12));
        std::ranges::shuffle(errors, random);
        RC_ASSERT(std::abs(figures(errors).rmse_m - f.rmse_m) < 1e-12);
        for (double& e : errors) e *= 2;
        RC_ASSERT(std::abs(figures(errors).p95_m - 2 * f.p95_m) < 1e-12);
    }));
}

TEST(Statistics, SplitTheErrorByAxisAndPlane) {
    const std::vector<Pair> pairs{pair({3, 4, 12}), pair({-3, 4, 0})};
    const Statistics s = statistics(pairs, {});
    EXPECT_DOUBLE_EQ(s.spatial.max_m, 13);
    EXPECT_DOUBLE_EQ(s.spatial.mean_m, 9);
    EXPECT_DOUBLE_EQ(s.horizontal.mean_m, 5);
    EXPECT_DOUBLE_EQ(s.axes[0].rmse_m, 3);
    EXPECT_DOUBLE_EQ(s.axes[2].mean_m, 6);
    EXPECT_DOUBLE_EQ(s.bias_m[0], 0);
    EXPECT_DOUBLE_EQ(s.bias_m[1], 4);
    EXPECT_DOUBLE_EQ(s.bias_m[2], 6);
    EXPECT_FALSE(s.horizontal_coverage);
    EXPECT_FALSE(s.vertical_coverage);
}

TEST(Statistics, CountHowOftenTheBoundHeld) {
    const std::vector<Pair> pairs{pair({3, 4, 1}, 5.5, 0.5), pair({3, 4, 1}, 4.5, 1.5), pair({3, 4, 1}, 8, no_bound),
                                  pair({0, 0, 0})};
    const Statistics s = statistics(pairs, {});
    ASSERT_TRUE(s.horizontal_coverage && s.vertical_coverage);
    EXPECT_EQ(s.horizontal_coverage->count, 3u);
    EXPECT_DOUBLE_EQ(s.horizontal_coverage->share, 2.0 / 3);
    EXPECT_DOUBLE_EQ(s.horizontal_coverage->mean_bound_m, 6);
    EXPECT_EQ(s.vertical_coverage->count, 2u);
    EXPECT_DOUBLE_EQ(s.vertical_coverage->share, 0.5);
}

TEST(Statistics, TheBoundIsScaledWithTheEstimate) {
    Similarity twice;
    twice.scale = 2;
    twice.translation_m = {-10, -20, -30};
    const std::vector<Pair> pairs{pair({1, 0, 0}, 1.5, no_bound)}; // the error becomes 2 m, the bound 3 m
    const Statistics s = statistics(pairs, twice);
    EXPECT_DOUBLE_EQ(s.horizontal.max_m, 2);
    EXPECT_DOUBLE_EQ(s.horizontal_coverage->mean_bound_m, 3);
    EXPECT_DOUBLE_EQ(s.horizontal_coverage->share, 1);
}

// The definition of docs/protocol.md: for equal sigmas the 95 % radius of a plane Gaussian is 2.4477 sigma.
TEST(Statistics, AnHonestGaussianBoundHoldsIn95Percent) {
    std::mt19937 random(7);
    std::normal_distribution<double> error(0, 0.2);
    std::vector<Pair> pairs;
    for (int i = 0; i < 20000; ++i)
        pairs.push_back(pair({error(random), error(random), error(random)}, 2.4477 * 0.2, 1.95996 * 0.2));
    const Statistics s = statistics(pairs, {});
    const double four_sigma = 4 * std::sqrt(0.95 * 0.05 / 20000);
    EXPECT_NEAR(s.horizontal_coverage->share, 0.95, four_sigma);
    EXPECT_NEAR(s.vertical_coverage->share, 0.95, four_sigma);
}

} // namespace
} // namespace locus::evaluate
