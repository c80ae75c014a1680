// The pure parts that the threads are built of.
#include "daemon/handover.h"
#include "daemon/rate_limit.h"
#include "daemon/socket/reason_watch.h"
#include "daemon/vital_signs.h"

#include <gtest/gtest.h>

namespace locus {
namespace {

Timestamp at_s(double seconds) { return timestamp_from_s(seconds); }

TEST(VitalSigns, FeedsOnlyWhenBothThreadsMoved) {
    VitalSigns signs;
    EXPECT_TRUE(signs.both_moved(1, 1));
    EXPECT_FALSE(signs.both_moved(2, 1)) << "the publisher hangs";
    EXPECT_FALSE(signs.both_moved(1, 2)) << "the fusion thread hangs";
    EXPECT_TRUE(signs.both_moved(2, 2));
}

TEST(RateLimit, LetsABurstPassAndCountsTheRest) {
    RateLimit limit{3, std::chrono::seconds{1}};
    for (int i = 0; i < 3; ++i) EXPECT_EQ(limit.pass(at_s(100)), 0u);
    EXPECT_EQ(limit.pass(at_s(100)), std::nullopt);
    EXPECT_EQ(limit.pass(at_s(100.5)), std::nullopt);
    EXPECT_EQ(limit.pass(at_s(101.2)), 2u) << "two were held back";
    EXPECT_EQ(limit.pass(at_s(101.3)), std::nullopt);
}

TEST(ReasonWatch, TellsAChangeOnceAndAFlappingSourceEveryTenSeconds) {
    ReasonWatch watch;
    AidStatus source;
    const auto see = [&](Exclusion reason, double seconds) {
        source.last_verdict.reason = reason;
        return watch.see(source, at_s(seconds));
    };
    EXPECT_EQ(see(Exclusion::not_seen_yet, 1), std::nullopt);
    EXPECT_EQ(see(Exclusion::none, 2), Exclusion::none);
    EXPECT_EQ(see(Exclusion::none, 3), std::nullopt);
    EXPECT_EQ(see(Exclusion::innovation_too_large, 4), std::nullopt) << "too soon";
    EXPECT_EQ(see(Exclusion::none, 5), std::nullopt);
    EXPECT_EQ(see(Exclusion::innovation_too_large, 13), Exclusion::innovation_too_large);
    source.source = address(9);
    EXPECT_EQ(see(Exclusion::late, 13), Exclusion::late) << "another source has a pause of its own";
}

struct Counted {
    explicit Counted(int& alive) : alive_{alive} { ++alive_; }
    ~Counted() { --alive_; }
    int& alive_;
};

TEST(Handover, WhatNobodyTookIsFreedAndWhatDoesNotFitStays) {
    int alive = 0;
    {
        Handover<Counted, 2> handover;
        for (int i = 0; i < 2; ++i) {
            auto item = std::make_unique<Counted>(alive);
            EXPECT_TRUE(handover.give(item));
            EXPECT_EQ(item, nullptr);
        }
        auto third = std::make_unique<Counted>(alive);
        EXPECT_FALSE(handover.give(third));
        EXPECT_NE(third, nullptr);
        EXPECT_NE(handover.take(), nullptr);
        EXPECT_EQ(alive, 2);
    }
    EXPECT_EQ(alive, 0);
}

} // namespace
} // namespace locus
