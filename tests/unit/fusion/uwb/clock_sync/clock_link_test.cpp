// One link on its own: what it takes for a clock, what for an echo, what for a clock that jumped.
#include "fusion/uwb/clock_sync/clock_link.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace locus::uwb::clock_link_test {
namespace {

constexpr double interval_s = 0.15;

/// Packets of a transmitter whose clock runs 30 ppm slow against the receiver's; `late_s` on its way.
struct Packets {
    std::int64_t receiver_start = 5'000, transmitter_start = (std::int64_t{1} << 40) - 77;
    double rate = 30e-6;

    SyncStamps at(double time_s, double late_s = 0) const {
        const auto ticks = [](std::int64_t start, double ticks_since) {
            return static_cast<std::uint64_t>(start + std::llround(ticks_since)) & ((std::uint64_t{1} << 40) - 1);
        };
        return {ticks(transmitter_start, time_s / tick_s),
                {ticks(receiver_start, (time_s + late_s) / tick_s * (1 + rate)), timestamp_from_s(50 + time_s)}};
    }
};

ClockLink fresh() { return {CrystalModel{ClockSyncSettings{}}, WrappingClock{}}; }

ClockLink after(int packets, const Packets& source = {}) {
    ClockLink link = fresh();
    for (int i = 0; i < packets; ++i) link.hear(source.at(i * interval_s));
    return link;
}

TEST(ClockLink, IsBelievedWithTheFourthPacketThatKeepsStep) {
    ClockLink link = fresh();
    const Packets source;
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(link.hear(source.at(i * interval_s)).reason, Exclusion::clock_not_synchronised);
        EXPECT_FALSE(link.is_confirmed());
    }
    const Verdict fourth = link.hear(source.at(3 * interval_s));
    EXPECT_EQ(fourth.reason, Exclusion::none);
    EXPECT_TRUE(link.is_confirmed());
    EXPECT_LT(std::abs(fourth.innovation), 0.05f);
    EXPECT_GT(fourth.innovation_sigma, 0.05f);
}

TEST(ClockLink, TellsTheTransmittersTimeBeforeBetweenAndAfterPackets) {
    const ClockLink link = after(20);
    const Packets source;
    for (const double time_s : {1.9, 2.2, 2.31, 2.849, 2.9}) {
        const SyncStamps truth = source.at(time_s);
        const auto told = link.track().at(truth.received);
        ASSERT_TRUE(told) << time_s;
        const double off_ticks =
            static_cast<double>(WrappingClock{}.between(told->ticks, truth.sent_ticks_in_transmitter)) +
            told->rest_ticks;
        EXPECT_NEAR(off_ticks, 0, 3) << time_s;
        EXPECT_LT(std::sqrt(told->variance_ticks2) * tick_m, 0.1) << time_s;
        EXPECT_EQ(link.track().reaches_beyond(truth.received), time_s < 2.85) << time_s;
    }
}

TEST(ClockLink, IsTheLessCertainTheLongerThePacketIsAgo) {
    const ClockLink link = after(20);
    double before = 0;
    for (const double dt_s : {0.0, 0.1, 0.3, 1.0, 10.0, 900.0}) {
        const double variance = link.track().variance_after(dt_s);
        EXPECT_GT(variance, before);
        EXPECT_TRUE(std::isfinite(variance));
        before = variance;
    }
    EXPECT_GT(std::sqrt(link.track().variance_after(1)) * tick_m, ClockSyncSettings{}.max_clock_sigma_m);
}

TEST(ClockLink, AnEchoLeavesNoTrace) {
    ClockLink with = after(20), without = after(20);
    const Packets source;
    EXPECT_EQ(with.hear(source.at(20 * interval_s, 20e-9)).reason, Exclusion::innovation_too_large);
    with.hear(source.at(21 * interval_s));
    without.hear(source.at(21 * interval_s));
    const auto when = source.at(3.2).received;
    EXPECT_EQ(with.track().at(when)->ticks, without.track().at(when)->ticks);
    EXPECT_EQ(with.track().at(when)->rest_ticks, without.track().at(when)->rest_ticks);
}

TEST(ClockLink, AFirstPacketThatIsAnEchoOnlyDelaysTheStart) {
    ClockLink link = fresh();
    const Packets source;
    link.hear(source.at(0, 50e-9));
    for (int i = 1; i <= 6; ++i) link.hear(source.at(i * interval_s));
    EXPECT_TRUE(link.is_confirmed());
    const SyncStamps truth = source.at(0.95);
    EXPECT_EQ(WrappingClock{}.between(link.track().at(truth.received)->ticks, truth.sent_ticks_in_transmitter) / 4, 0);
}

TEST(ClockLink, AClockThatJumpedIsToldAndTakenOnAfterFourPackets) {
    for (const bool transmitter : {true, false}) {
        ClockLink link = after(20);
        Packets anew;
        (transmitter ? anew.transmitter_start : anew.receiver_start) += 300'000'000'000;
        for (int i = 20; i < 24; ++i) {
            EXPECT_EQ(link.hear(anew.at(i * interval_s)).reason, Exclusion::clock_jumped);
            EXPECT_TRUE(link.is_confirmed());
        }
        EXPECT_EQ(link.hear(anew.at(24 * interval_s)).reason, Exclusion::none);
    }
}

TEST(ClockLink, ASmallReceiverJumpThatHostTimeCannotTellIsAJumpAsWell) {
    ClockLink link = after(20);
    Packets anew;
    anew.receiver_start += 1'000'000; // 16 us
    EXPECT_EQ(link.hear(anew.at(20 * interval_s)).reason, Exclusion::clock_jumped);
}

TEST(ClockLink, RepeatedAndDisorderedPacketsChangeNothing) {
    ClockLink link = after(20);
    const Packets source;
    EXPECT_EQ(link.hear(source.at(19 * interval_s)).reason, Exclusion::duplicate);
    EXPECT_EQ(link.hear(source.at(17.5 * interval_s)).reason, Exclusion::late);
    EXPECT_EQ(link.hear(source.at(20 * interval_s)).reason, Exclusion::none);
}

TEST(ClockLink, GapsLongerThanTheCounterAreNoTrouble) {
    ClockLink link = after(20);
    const Packets source;
    for (const double time_s : {30.0, 100.0, 100.15, 500.0})
        EXPECT_EQ(link.hear(source.at(time_s)).reason, Exclusion::none) << time_s;
}

RC_GTEST_PROP(ClockLink, HostileStampsNeverMakeItHangOrLeaveTheFinite, ()) {
    ClockLink link = *rc::gen::arbitrary<bool>() ? fresh() : after(10);
    const auto count = *rc::gen::inRange(1, 40);
    for (int i = 0; i < count; ++i) {
        const auto host = timestamp_from_ns(*rc::gen::element(50'000'000'000, std::int64_t{51'500'000'000},
                                                              std::numeric_limits<std::int64_t>::min() / 4,
                                                              std::numeric_limits<std::int64_t>::max() / 4) +
                                            *rc::gen::inRange(0, 1'000'000'000));
        const SyncStamps stamps{*rc::gen::arbitrary<std::uint64_t>(), {*rc::gen::arbitrary<std::uint64_t>(), host}};
        const Verdict verdict = link.hear(stamps);
        RC_ASSERT(std::isnan(verdict.innovation) || std::isfinite(verdict.innovation));
        const auto told = link.track().at({*rc::gen::arbitrary<std::uint64_t>(), host});
        if (told) RC_ASSERT(std::isfinite(told->rest_ticks) && std::isfinite(told->variance_ticks2));
        RC_ASSERT(std::isfinite(link.track().variance_after(1000)));
    }
}

/// protocols.md E-2: two sync packets that a listener of Decawave's heard.
TEST(ClockTrack, FindsTheRateOfTheRealSyncPackets) {
    ClockTrack track{CrystalModel{ClockSyncSettings{}}, WrappingClock{}};
    track.start({0x499137C050, {959949481290, timestamp_from_s(32.240936)}});
    EXPECT_EQ(track.hear({0x4D91380050, {977129894189, timestamp_from_s(32.509826)}}).outcome,
              ClockTrack::Outcome::accepted);
    EXPECT_NEAR(track.receiver_rate(), 30.7e-6, 0.05e-6);
}

} // namespace
} // namespace locus::uwb::clock_link_test
