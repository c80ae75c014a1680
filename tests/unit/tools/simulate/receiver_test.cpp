#include "tools/simulate/receiver.h"

#include <gtest/gtest.h>

#include <cmath>

namespace locus::simulate {
namespace {

using Eigen::Vector3d;

const Vector3d position{5, 0, 1};

Scenario two_anchors() {
    Scenario scenario;
    scenario.site.anchors = {{"a", address(1), {0, 0, 1}}, {"b", address(2), {15, 0, 1}}};
    scenario.movers.resize(1);
    scenario.movers[0].target.address = address(7);
    return scenario;
}

std::vector<Range> ranges(Receiver& receiver, const Vector3d& at = position) {
    std::vector<Range> ranges;
    for (const Observation& observation : receiver.measure(0, at)) ranges.push_back(std::get<Range>(observation));
    return ranges;
}

TEST(Receiver, WithoutNoiseMeasuresTheDistance) {
    const Scenario scenario = two_anchors();
    Receiver receiver(scenario, {.sigma_m = 0}, 0);
    const auto measured = ranges(receiver);
    ASSERT_EQ(measured.size(), 2u);
    EXPECT_EQ(measured[0].anchor, address(1));
    EXPECT_EQ(measured[0].tag, address(7));
    EXPECT_DOUBLE_EQ(measured[0].range_m, 5);
    EXPECT_DOUBLE_EQ(measured[1].range_m, 10);
}

TEST(Receiver, DifferencesHaveTheSignOfTheVocabulary) {
    const Scenario scenario = two_anchors();
    Receiver receiver(scenario, {.mode = "range_differences", .sigma_m = 0}, 0);
    const auto measured = receiver.measure(0, position);
    ASSERT_EQ(measured.size(), 1u);
    const auto& difference = std::get<RangeDifference>(measured[0]);
    EXPECT_EQ(difference.anchor_a, address(1));
    EXPECT_EQ(difference.anchor_b, address(2));
    EXPECT_DOUBLE_EQ(difference.difference_m, 10 - 5);
}

TEST(Receiver, NoiseHasTheStatedSigma) {
    const Scenario scenario = two_anchors();
    Receiver receiver(scenario, {.sigma_m = 0.1}, 0);
    double sum = 0, squares = 0;
    constexpr int count = 20'000;
    for (int i = 0; i < count; ++i) {
        const double error_m = ranges(receiver)[0].range_m - 5;
        sum += error_m;
        squares += error_m * error_m;
    }
    EXPECT_NEAR(sum / count, 0, 0.1 * 4 / std::sqrt(count));
    EXPECT_NEAR(std::sqrt(squares / count), 0.1, 0.002);
}

TEST(Receiver, LosesTheStatedShare) {
    const Scenario scenario = two_anchors();
    Receiver receiver(scenario, {.loss = 0.25}, 0);
    std::size_t heard = 0;
    for (int i = 0; i < 10'000; ++i) heard += ranges(receiver).size();
    EXPECT_NEAR(static_cast<double>(heard) / 20'000, 0.75, 0.0125);
}

TEST(Receiver, HearsNobodyOutOfReach) {
    const Scenario scenario = two_anchors();
    Receiver receiver(scenario, {.reach_m = 7}, 0);
    const auto measured = ranges(receiver);
    ASSERT_EQ(measured.size(), 1u);
    EXPECT_EQ(measured[0].anchor, address(1));
}

TEST(Receiver, AShadowAddsABiasThatLastsAsLongAsTheShadow) {
    Scenario scenario = two_anchors();
    scenario.walls = {{{10, -1, 0}, {10, 1, 3}, 0.5, 1.5}};
    Receiver receiver(scenario, {.sigma_m = 0}, 0);
    const auto bias_m = [&] { return ranges(receiver)[1].range_m - 10; };
    const double first = bias_m();
    EXPECT_GE(first, 0.5);
    EXPECT_LE(first, 1.5);
    for (int i = 0; i < 5; ++i) EXPECT_DOUBLE_EQ(bias_m(), first);
    EXPECT_DOUBLE_EQ(ranges(receiver)[0].range_m, 5) << "the other link is clear";
    EXPECT_DOUBLE_EQ(ranges(receiver, {12, 0, 1})[1].range_m, 3) << "out of the shadow";
    EXPECT_NE(bias_m(), first) << "a new shadow";
}

TEST(Receiver, AWallCanBlockAltogether) {
    Scenario scenario = two_anchors();
    scenario.walls = {{{10, -1, 0}, {10, 1, 3}, 0, 0, 1}};
    Receiver receiver(scenario, {}, 0);
    for (int i = 0; i < 100; ++i) ASSERT_EQ(ranges(receiver).size(), 1u);
}

TEST(Receiver, SeedAndPlaceMakeTheNoise) {
    Scenario scenario = two_anchors();
    const auto first = [&](unsigned number) {
        Receiver receiver(scenario, {}, number);
        return ranges(receiver)[0].range_m;
    };
    const double before = first(0);
    EXPECT_EQ(first(0), before);
    EXPECT_NE(first(1), before);
    scenario.simulation.seed = 2;
    EXPECT_NE(first(0), before);
}

} // namespace
} // namespace locus::simulate
