// The engine's answers to good and bad measurements, one at a time. That the order of arrival does not matter is
// proved in engine_order_test.cpp, that nothing is allocated in engine_allocation_test.cpp.
#include "tests/unit/fusion/engine_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace locus::engine_test {
namespace {

const AidStatus& source(const Engine& engine, std::uint64_t number, SourceKind kind = SourceKind::anchor) {
    static const AidStatus nobody;
    const auto sources = engine.sources();
    const auto found = std::find_if(sources.begin(), sources.end(), [&](const AidStatus& status) {
        return status.kind == kind && status.source == address(number);
    });
    EXPECT_NE(found, sources.end()) << "no status of source " << number;
    return found == sources.end() ? nobody : *found;
}

std::uint64_t count(const Engine& engine, Exclusion reason) {
    return engine.counters().by_reason[static_cast<std::size_t>(reason)];
}

/// Two ranges, so that the follower has started.
void start(Engine& engine, double time_s = 10, std::uint64_t tag = 100) {
    engine.submit(range(time_s, 5, 0, 0, tag), at(time_s));
    engine.submit(range(time_s, 5, 1, 1, tag), at(time_s));
}

TEST(Engine, SaysWhatIsMissingUntilThereIsAPoseThenGivesIt) {
    Engine engine(follower_settings());
    auto poses = engine.step(at(1));
    ASSERT_EQ(poses.size(), 1u);
    EXPECT_EQ(poses[0].target, address(100));
    EXPECT_EQ(poses[0].estimate.missing, Missing::measurements);
    engine.submit(range(1.001, 5), at(1.001));
    EXPECT_EQ(engine.step(at(1.01))[0].estimate.missing, Missing::anchors);
    engine.submit(range(1.011, 5, 1), at(1.011));
    poses = engine.step(at(1.02));
    EXPECT_EQ(poses[0].estimate.missing, Missing::nothing);
    EXPECT_EQ(poses[0].estimate.time, at(1.02));
    EXPECT_NEAR(poses[0].estimate.position_site_m[0], 5, 1e-9);
    EXPECT_NEAR(static_cast<double>(poses[0].horizontal_error_95_m), 0.1 * 2.4477, 0.005);
    EXPECT_NEAR(static_cast<double>(poses[0].vertical_error_95_m), 0.1 * 1.95996, 1e-5);
}

TEST(Engine, OutputTimesStrictlyIncrease) {
    Engine engine(follower_settings());
    EXPECT_EQ(engine.step(at(1)).size(), 1u);
    EXPECT_TRUE(engine.step(at(1)).empty());
    EXPECT_TRUE(engine.step(at(0.5)).empty());
    EXPECT_EQ(engine.step(at(1.001)).size(), 1u);
}

TEST(Engine, AMeasurementAfterTheTickWaitsForItsOwn) {
    Engine engine(follower_settings());
    start(engine);
    engine.submit(range(10.004, 6, 2), at(10.001)); // within the tolerance of stamps
    EXPECT_EQ(engine.step(at(10.002))[0].estimate.kinds_used, 2u);
    EXPECT_EQ(engine.counters().used, 1u);
    EXPECT_EQ(engine.step(at(10.005))[0].estimate.kinds_used, 3u);
    EXPECT_EQ(engine.counters().used, 2u);
}

TEST(Engine, RefusesALateOneAndTheStatusOfItsAnchorSaysSo) {
    Engine engine(follower_settings());
    start(engine);
    engine.step(at(10.01));
    engine.submit(range(10.05, 5, 3, 2), at(10.251));
    EXPECT_EQ(engine.counters().late, 1u);
    EXPECT_EQ(engine.counters().refused, 1u); // the one that waited for the start
    const AidStatus& status = source(engine, 2);
    EXPECT_EQ(status.last_verdict.reason, Exclusion::late);
    EXPECT_EQ(status.counters.received, 1u);
    EXPECT_EQ(status.counters.late, 1u);
    EXPECT_EQ(status.counters.refused, 0u);
    EXPECT_NEAR(static_cast<double>(status.delay_s), 0.201, 1e-6);
}

TEST(Engine, AMeasurementAtTheVeryEdgeOfTheWindowStillCounts) {
    Engine engine(follower_settings());
    start(engine);
    engine.submit(range(10.2, 5, 3, 2), at(10.2));
    engine.step(at(10.2));
    engine.submit(range(10.0, 5, 4, 2), at(10.2));
    engine.step(at(10.21));
    EXPECT_EQ(engine.counters().late, 0u);
    EXPECT_EQ(engine.counters().used, 3u);
    EXPECT_EQ(engine.counters().rolled_back, 1u);
}

TEST(Engine, RefusesADuplicateBeforeAndAfterItsTick) {
    Engine engine(follower_settings());
    start(engine);
    engine.submit(range(10, 5, 1, 1), at(10));
    engine.step(at(10.01));
    engine.submit(range(10, 5, 1, 1), at(10.02));
    engine.step(at(10.03));
    EXPECT_EQ(count(engine, Exclusion::duplicate), 2u);
    EXPECT_EQ(engine.counters().used, 1u);
    EXPECT_EQ(engine.counters().rolled_back, 0u);
}

TEST(Engine, RangesOfOneSweepAreNoDuplicatesEvenWithoutSequenceNumbers) {
    Engine engine(follower_settings());
    for (std::uint64_t anchor = 0; anchor < 4; ++anchor) engine.submit(range(10, 5, 0, anchor), at(10));
    engine.step(at(10));
    EXPECT_EQ(count(engine, Exclusion::duplicate), 0u);
    EXPECT_EQ(engine.counters().used, 3u);
}

TEST(Engine, RefusesStampsFromTheFutureWithoutBelievingTheirTime) {
    Engine engine(follower_settings());
    start(engine);
    engine.submit(range(1e6, 5, 2), at(10.001));
    EXPECT_EQ(source(engine, 0).last_verdict.reason, Exclusion::stamp_in_future);
    engine.submit(range(10.002, 5, 3), at(10.002));
    engine.step(at(10.01));
    EXPECT_EQ(source(engine, 0).last_verdict.reason, Exclusion::none);
    EXPECT_EQ(source(engine, 0).last_time, at(10.002));
    EXPECT_EQ(count(engine, Exclusion::stamp_in_future), 1u);
}

TEST(Engine, StampsAtTheEndsOfTimeDoNoHarm) {
    Engine engine(follower_settings());
    start(engine);
    Measurement oldest = range(0, 5, 2), newest = range(0, 5, 3);
    oldest.time = Timestamp::min();
    newest.time = Timestamp::max();
    engine.submit(oldest, at(10));
    engine.submit(newest, at(10));
    engine.step(at(10.01));
    EXPECT_EQ(engine.counters().late, 1u);
    EXPECT_EQ(count(engine, Exclusion::stamp_in_future), 1u);
}

TEST(Engine, RefusesWhatIsNotFinite) {
    Engine engine(follower_settings());
    start(engine);
    engine.submit(range(10, std::nan(""), 2), at(10));
    engine.submit(range(10, std::numeric_limits<double>::infinity(), 3), at(10));
    EXPECT_EQ(count(engine, Exclusion::not_finite), 2u);
    EXPECT_TRUE(std::isfinite(engine.step(at(10.01))[0].estimate.position_site_m[0]));
    EXPECT_TRUE(std::isfinite(source(engine, 0).last_observation));
}

TEST(Engine, AnAnchorThatTheSiteDoesNotKnowGetsAStatusOfItsOwn) {
    Engine engine(follower_settings());
    engine.submit(range(10, 5, 0, 77), at(10));
    const AidStatus& status = source(engine, 77);
    EXPECT_EQ(status.last_verdict.reason, Exclusion::unknown_source);
    EXPECT_EQ(status.counters.refused, 1u);
    EXPECT_EQ(status.last_target, address(100));
    EXPECT_EQ(engine.step(at(10.01))[0].estimate.missing, Missing::measurements);
}

TEST(Engine, OfADifferenceOnlyTheUnknownAnchorIsBlamed) {
    Engine engine(follower_settings());
    RangeDifference difference;
    difference.anchor_a = address(1);
    difference.anchor_b = address(55);
    difference.tag = address(100);
    engine.submit({at(10), 0, 0, difference}, at(10));
    EXPECT_EQ(source(engine, 55).counters.refused, 1u);
    EXPECT_EQ(source(engine, 1).counters.received, 0u);
    EXPECT_EQ(source(engine, 1).last_verdict.reason, Exclusion::not_seen_yet);
}

TEST(Engine, MoreStrangersThanThereIsRoomForAreCountedInTheTotal) {
    Engine engine(follower_settings());
    for (std::uint32_t i = 0; i < 1000; ++i) engine.submit(range(10, 5, i, 1000 + i), at(10));
    EXPECT_EQ(count(engine, Exclusion::unknown_source), 1000u);
    EXPECT_LT(engine.sources().size(), 200u);
}

TEST(Engine, AFullWindowRefusesAndCountsAndIsFreeAgainLater) {
    Engine engine(follower_settings());
    for (std::uint32_t i = 0; i < 5000; ++i) engine.submit(range(10, 5, i), at(10));
    engine.step(at(10));
    const auto refused = count(engine, Exclusion::window_full);
    EXPECT_GT(refused, 4000u);
    EXPECT_EQ(engine.counters().used + engine.counters().refused, 5000u);
    engine.step(at(10.3));
    engine.submit(range(10.31, 5, 5000), at(10.31));
    engine.step(at(10.32));
    EXPECT_EQ(count(engine, Exclusion::window_full), refused);
    EXPECT_EQ(source(engine, 0).last_used_time, at(10.31));
}

TEST(Engine, StrangeTagsGetSlotsUntilThereAreNoMore) {
    Engine engine(follower_settings());
    for (std::uint64_t tag = 0xA0; tag < 0xA5; ++tag) start(engine, 10, tag);
    const auto poses = engine.step(at(10));
    ASSERT_EQ(poses.size(), 4u);
    EXPECT_EQ(engine.target_name(0), "cart");
    EXPECT_EQ(poses[0].estimate.missing, Missing::measurements);
    EXPECT_EQ(engine.target_name(3), "0xa2");
    EXPECT_EQ(poses[3].target, address(0xA2));
    EXPECT_EQ(poses[3].target_index, 3u);
    EXPECT_EQ(poses[3].estimate.missing, Missing::nothing);
    EXPECT_EQ(count(engine, Exclusion::unknown_target), 4u);
}

TEST(Engine, StrangeTagsAreRefusedWhereTheyAreNotWanted) {
    auto settings = follower_settings();
    settings.fusion.accept_unknown_targets = false;
    Engine engine(settings);
    start(engine, 10, 7);
    EXPECT_EQ(engine.step(at(10)).size(), 1u);
    EXPECT_EQ(count(engine, Exclusion::unknown_target), 2u);
}

TEST(Engine, ATagWithoutANumberIsNobody) {
    Engine engine(follower_settings());
    engine.submit(range(10, 5, 0, 0, number(no_address)), at(10));
    EXPECT_EQ(count(engine, Exclusion::unknown_target), 1u);
    EXPECT_EQ(engine.step(at(10)).size(), 1u);
}

TEST(Engine, ARangeBetweenTwoTagsGoesToBoth) {
    Engine engine(follower_settings());
    PeerRange peer;
    peer.tag_a = address(100);
    peer.tag_b = address(101);
    peer.range_m = 2;
    engine.submit({at(10), 0, 0, peer}, at(10));
    EXPECT_EQ(engine.step(at(10)).size(), 2u);
    EXPECT_EQ(count(engine, Exclusion::unsupported_kind), 2u); // the follower has no use for it
    EXPECT_EQ(source(engine, 101, SourceKind::tag).last_target, address(100));
    EXPECT_EQ(source(engine, 100, SourceKind::tag).last_target, address(101));
}

TEST(Engine, KindsThatNameNoTagAreRefusedButSeen) {
    Engine engine(follower_settings());
    FootPoint foot;
    foot.camera = address(77);
    engine.submit({at(10), 0, 0, foot}, at(10));
    EXPECT_EQ(source(engine, 77, SourceKind::camera).last_verdict.reason, Exclusion::unknown_camera);
    EXPECT_EQ(source(engine, 77, SourceKind::camera).counters.refused, 1u);
}

TEST(Engine, TwoTargetsDoNotTouchEachOther) {
    Engine alone(follower_settings()), together(follower_settings());
    for (std::uint32_t i = 0; i < 50; ++i) {
        const double time_s = 10 + 0.02 * i;
        const auto mine = range(time_s, 5 + std::sin(i), i);
        alone.submit(mine, at(time_s));
        together.submit(range(time_s - 0.05, 40 + i, i, 0, 101), at(time_s));
        together.submit(mine, at(time_s));
        const auto expected = alone.step(at(time_s + 0.01))[0];
        ASSERT_TRUE(same_bits(expected.estimate, together.step(at(time_s + 0.01))[0].estimate));
    }
}

TEST(Engine, ATargetUnheardForTooLongIsLostAndFoundAgainFromAFreshStart) {
    Engine engine(follower_settings());
    start(engine);
    EXPECT_EQ(engine.step(at(11))[0].estimate.missing, Missing::nothing);
    EXPECT_EQ(engine.step(at(11.01))[0].estimate.missing, Missing::fresh_measurements);
    engine.submit(range(20, 50, 5), at(20)); // far off: only a fresh start takes it
    EXPECT_EQ(engine.step(at(20))[0].estimate.missing, Missing::anchors);
    engine.submit(range(20.01, 50, 6), at(20.01));
    const auto found = engine.step(at(20.02))[0].estimate;
    EXPECT_EQ(found.missing, Missing::nothing);
    EXPECT_NEAR(found.position_site_m[0], 50, 1e-9);
    EXPECT_EQ(found.reset_count, 1u);
}

TEST(Engine, ResetsOfTheEstimatorSurviveAFreshStart) {
    Engine engine(follower_settings());
    start(engine);
    for (std::uint32_t i = 2; i < 5; ++i) engine.submit(range(10.01, 50, i), at(10.01)); // the third makes it reset
    EXPECT_EQ(engine.step(at(10.02))[0].estimate.reset_count, 1u);
    start(engine, 20);
    EXPECT_EQ(engine.step(at(20.01))[0].estimate.reset_count, 2u);
}

TEST(Engine, ARollBackReplacesTheVerdictsThatItChanges) {
    Engine engine(follower_settings());
    start(engine);
    engine.submit(range(10.03, 12, 7, 3), at(10.03));
    engine.step(at(10.04));
    EXPECT_EQ(source(engine, 3).last_verdict.reason, Exclusion::innovation_too_large);
    EXPECT_EQ(source(engine, 3).counters.refused, 1u);
    for (std::uint32_t i = 2; i < 5; ++i) engine.submit(range(10.02, 12, i, 2), at(10.05)); // it was right after all
    engine.step(at(10.06));
    EXPECT_EQ(source(engine, 3).last_verdict.reason, Exclusion::none);
    EXPECT_EQ(source(engine, 3).counters.refused, 0u);
    EXPECT_EQ(source(engine, 3).counters.used, 1u);
    const auto& total = engine.counters();
    EXPECT_EQ(total.received, 6u);
    EXPECT_EQ(total.used, 3u);
    EXPECT_EQ(total.refused, 3u);
    EXPECT_EQ(count(engine, Exclusion::innovation_too_large), 2u);
    EXPECT_EQ(total.rolled_back, 1u);
}

TEST(Engine, RatesFollowWhatIsHeardAndFallWithSilence) {
    Engine engine(follower_settings());
    for (std::uint32_t i = 0; i < 500; ++i) {
        engine.submit(range(10 + 0.02 * i, 5, i), at(10 + 0.02 * i));
        engine.step(at(10.001 + 0.02 * i));
    }
    EXPECT_NEAR(static_cast<double>(source(engine, 0).rate_hz), 50, 1.5);
    for (int i = 0; i < 100; ++i) engine.step(at(20.1 + 0.1 * i));
    EXPECT_LT(source(engine, 0).rate_hz, 1);
}

TEST(Engine, SettingsThatCannotWorkAreRefusedWithASentence) {
    auto unknown = follower_settings();
    unknown.fusion.estimator = "crystal_ball";
    EXPECT_THROW(Engine{unknown}, std::invalid_argument);
    auto twice = follower_settings();
    twice.targets.push_back({"other", address(100), {}});
    EXPECT_THROW(Engine{twice}, std::invalid_argument);
    auto many = follower_settings();
    many.fusion.max_targets = 1;
    many.targets.push_back({"other", address(101), {}});
    EXPECT_THROW(Engine{many}, std::invalid_argument);
}

} // namespace
} // namespace locus::engine_test
