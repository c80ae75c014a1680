// Assignment: against every permutation, against dlib, rectangular, and with pairs that may not be.
#include "fusion/vision/assignment.h"

#include <dlib/optimization/max_cost_assignment.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace locus::vision {
namespace {

constexpr double limit_of_tests = 10;

double total_gain(const Costs& costs, const Pairing& pairs) {
    double gain = 0;
    for (const auto& [row, column] : pairs) gain += limit_of_tests - costs.at(row, column);
    return gain;
}

/// Tries everything: the row stays alone or takes one of the columns that are left.
double best_gain(const Costs& costs, std::size_t row, std::vector<bool>& taken) {
    if (row == costs.rows()) return 0;
    double best = best_gain(costs, row + 1, taken);
    for (std::size_t column = 0; column < costs.columns(); ++column) {
        if (taken[column] || !(costs.at(row, column) < limit_of_tests)) continue;
        taken[column] = true;
        best = std::max(best, limit_of_tests - costs.at(row, column) + best_gain(costs, row + 1, taken));
        taken[column] = false;
    }
    return best;
}

RC_GTEST_PROP(Assignment, IsTheBestOfAll, ()) {
    Costs costs(*rc::gen::inRange<std::size_t>(0, 6), *rc::gen::inRange<std::size_t>(0, 6));
    for (std::size_t i = 0; i < costs.rows(); ++i)
        for (std::size_t j = 0; j < costs.columns(); ++j) costs.at(i, j) = 0.1 * *rc::gen::inRange(-50, 150);
    const Pairing pairs = assign(costs, limit_of_tests);
    std::vector<bool> taken(costs.columns(), false);
    std::vector<std::size_t> columns;
    for (const auto& [row, column] : pairs) {
        RC_ASSERT(costs.at(row, column) < limit_of_tests);
        columns.push_back(column);
    }
    std::sort(columns.begin(), columns.end());
    RC_ASSERT(std::adjacent_find(columns.begin(), columns.end()) == columns.end());
    RC_ASSERT(std::abs(total_gain(costs, pairs) - best_gain(costs, 0, taken)) < 1e-3);
}

/// Fifty by fifty is more than every permutation can tell; dlib assigns all, so no pair is forbidden here.
TEST(Assignment, IsThatOfDlib) {
    constexpr long side = 50;
    std::mt19937 random(7);
    std::uniform_int_distribution<int> cost(0, 999);
    Assigner assigner(side, side);
    for (int trial = 0; trial < 20; ++trial) {
        Costs costs(side, side);
        dlib::matrix<int> gains(side, side);
        for (long i = 0; i < side; ++i)
            for (long j = 0; j < side; ++j) {
                const int one = cost(random);
                costs.at(static_cast<std::size_t>(i), static_cast<std::size_t>(j)) = one;
                gains(i, j) = -one;
            }
        double total = 0;
        for (const auto& [row, column] : assigner.assign(costs, 1e5)) total += costs.at(row, column);
        EXPECT_EQ(total, -dlib::assignment_cost(gains, dlib::max_cost_assignment(gains))) << trial;
    }
}

TEST(Assignment, NobodyIsForced) {
    Costs costs(2, 3);
    EXPECT_TRUE(assign(costs, 1).empty()) << "all forbidden";
    costs.at(1, 2) = 0.5;
    costs.at(0, 2) = std::nan("");
    EXPECT_EQ(assign(costs, 1), (Pairing{{1, 2}}));
    costs.at(1, 2) = 1;
    EXPECT_TRUE(assign(costs, 1).empty()) << "to stay alone is as good";
    costs.at(1, 2) = -std::numeric_limits<double>::infinity();
    EXPECT_EQ(assign(costs, 1), (Pairing{{1, 2}})) << "counts as -limit";
    EXPECT_TRUE(assign(Costs(0, 5), 1).empty());
    EXPECT_TRUE(assign(Costs(5, 0), 1).empty());
}

TEST(Assignment, TheSumCountsNotTheNearest) {
    // Paper 000 eq. 28: row 0 is nearest to column 0, but then row 1 has to go far.
    Costs costs(2, 2);
    costs.at(0, 0) = 1;
    costs.at(0, 1) = 2;
    costs.at(1, 0) = 2;
    costs.at(1, 1) = 9;
    EXPECT_EQ(assign(costs, 10), (Pairing{{0, 1}, {1, 0}}));
}

} // namespace
} // namespace locus::vision
