// Who is root, and by which way the others are reached.
#include "fusion/uwb/clock_sync/clock_graph.h"

#include <gtest/gtest.h>

#include <cmath>

namespace locus::uwb::clock_graph_test {
namespace {

constexpr double interval_s = 0.15;

/// All clocks are perfect and alike, so that only the ways count. Anchors in a row, 3 m apart.
struct Row {
    Site site;
    ClockSyncSettings settings;
    std::optional<ClockGraph> graph;

    explicit Row(std::size_t anchors, Address master = no_address) {
        for (std::size_t i = 0; i < anchors; ++i)
            site.anchors.push_back({"", address(i), {3.0 * static_cast<double>(i), 0, 0}});
        settings.master = master;
        graph.emplace(site, settings);
    }

    static std::uint64_t ticks(double time_s) { return static_cast<std::uint64_t>(std::llround(time_s / tick_s)); }

    Verdict sync(ClockGraph::Node from, ClockGraph::Node to, double time_s) {
        const double flight_s =
            3.0 * std::abs(static_cast<double>(from) - static_cast<double>(to)) / speed_of_light_mps;
        return graph->hear(from, to, {ticks(time_s), {ticks(time_s + flight_s), timestamp_from_s(time_s)}});
    }

    /// `seconds` of packets over these links, then a refresh.
    void run(const std::vector<std::pair<int, int>>& links, double from_s, double seconds) {
        for (double t = from_s; t < from_s + seconds; t += interval_s)
            for (const auto& [from, to] : links)
                sync(static_cast<ClockGraph::Node>(from), static_cast<ClockGraph::Node>(to), t);
        graph->refresh(timestamp_from_s(from_s + seconds));
    }

    std::optional<ClockGraph::RootTime> at(ClockGraph::Node node, double time_s) const {
        return graph->root_time(node, {ticks(time_s), timestamp_from_s(time_s)});
    }
};

TEST(ClockGraph, HasNoRootBeforeAnybodyIsHeard) {
    Row row(3);
    row.graph->refresh(timestamp_from_s(1));
    EXPECT_EQ(row.graph->root(), ClockGraph::nobody);
    EXPECT_FALSE(row.at(0, 1));
}

TEST(ClockGraph, TheRootIsWhoReachesMostNotWhoIsHeardFirst) {
    Row row(5);
    row.run({{1, 2}}, 0, 2);
    EXPECT_EQ(row.graph->root(), 1);
    row.run({{1, 2}, {0, 1}, {0, 3}}, 2, 2);
    EXPECT_EQ(row.graph->root(), 0);
    EXPECT_EQ(row.at(0, 4)->length, 0u);
    EXPECT_EQ(row.at(1, 4)->length, 1u);
    EXPECT_EQ(row.at(2, 4)->length, 2u);
    EXPECT_FALSE(row.at(4, 4)) << "nobody reaches it";
}

TEST(ClockGraph, OfTwoWaysTheMoreCertainIsTaken) {
    Row row(4, address(0));
    row.run({{0, 1}, {1, 2}, {0, 2}, {2, 3}}, 0, 3);
    EXPECT_EQ(row.at(2, 3)->length, 1u);
    EXPECT_EQ(row.at(3, 3)->length, 2u);
    row.run({{0, 1}, {1, 2}}, 3, 3); // 0 is not heard at 2 any more
    EXPECT_EQ(row.at(2, 6)->length, 2u);
}

TEST(ClockGraph, DistancesBetweenAnchorsDoNotShowInTheTime) {
    Row row(4);
    row.run({{0, 1}, {1, 2}, {2, 3}}, 0, 3);
    for (ClockGraph::Node i = 0; i < 4; ++i) {
        const auto told = row.at(i, 2.95);
        ASSERT_TRUE(told);
        EXPECT_NEAR(static_cast<double>(WrappingClock{}.between(told->time.ticks, Row::ticks(2.95))) +
                        told->time.rest_ticks,
                    0, 2);
    }
}

TEST(ClockGraph, AnAntennaDelayLiesOnTheWayOfASyncPacket) {
    Row row(2);
    row.site.anchors[0].antenna_delay_m = 154.6;
    row.run({{0, 1}}, 0, 3);
    const auto told = row.at(1, 2.95);
    EXPECT_NEAR(static_cast<double>(WrappingClock{}.between(told->time.ticks, Row::ticks(2.95))) +
                    told->time.rest_ticks,
                154.6 / tick_m, 2);
}

TEST(ClockGraph, WhatTwoWaysHaveInCommonIsNoUncertaintyBetweenThem) {
    Row row(4, address(0));
    row.run({{0, 1}, {1, 2}, {1, 3}}, 0, 3);
    const auto one = *row.at(1, 3), two = *row.at(2, 3), three = *row.at(3, 3);
    EXPECT_NEAR(ClockGraph::variance_between(two, one), two.variances_ticks2[0], 1e-12);
    EXPECT_NEAR(ClockGraph::variance_between(two, three), two.variances_ticks2[0] + three.variances_ticks2[0], 1e-12);
    EXPECT_EQ(ClockGraph::variance_between(two, two), 0);
}

TEST(ClockGraph, LoopsAndManyTransmittersEndWell) {
    Row row(12);
    std::vector<std::pair<int, int>> all;
    for (int i = 0; i < 12; ++i)
        for (int j = 0; j < 12; ++j)
            if (i != j) all.emplace_back(i, j);
    row.run(all, 0, 3);
    EXPECT_NE(row.graph->root(), ClockGraph::nobody);
    for (ClockGraph::Node i = 0; i < 12; ++i) EXPECT_TRUE(row.at(i, 3)) << i;
    EXPECT_EQ(row.sync(3, 3, 4).reason, Exclusion::clock_not_synchronised) << "nobody hears itself";
}

TEST(ClockGraph, ATransmitterLongSilentGivesItsPlaceToAnother) {
    Row row(12, address(10));
    std::vector<std::pair<int, int>> to_11;
    for (int i = 0; i < 9; ++i) to_11.emplace_back(i, 11);
    row.run(to_11, 0, 3);
    row.run({{10, 11}}, 3, 3);
    EXPECT_FALSE(row.at(11, 6)) << "all places are taken";
    row.run({{10, 11}}, 20, 3);
    EXPECT_TRUE(row.at(11, 23));
}

} // namespace
} // namespace locus::uwb::clock_graph_test
