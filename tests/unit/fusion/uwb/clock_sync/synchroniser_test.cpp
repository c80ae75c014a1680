// Crystals 20 ppm apart that drift by 0.1 ppm/s, sync packets each 150 ms, arrival stamps 150 ps off: range differences
// must be hardly worse than perfect clocks would make them, and their sigma must be true.
#include "tests/unit/fusion/uwb/clock_sync/rig.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace locus::clock_test {
namespace {

void print(const char* what, const Tally& t) {
    std::printf(
        "%s: %d differences, rms %.4f m, perfect clocks %.4f m, ratio %.3f, normalised square %.3f, worst %.2f sigma\n",
        what, t.count, t.rms_m(), t.rms_m() / t.ratio(), t.ratio(), t.normalised(), t.worst_in_sigma);
}

/// Neighbours drift apart from each other, for as long as it lasts.
void drift_steadily(SimulatedAnchors& world) {
    double drift_per_s = 1e-7;
    for (auto& crystal : world.crystals)
        crystal.drift_per_s = crystal.mean_drift_per_s = std::exchange(drift_per_s, -drift_per_s);
}

void wander(SimulatedAnchors& world, double time_s) {
    for (auto& crystal : world.crystals) {
        crystal.wander_per_s = 1e-7;
        crystal.wander_time_s = time_s;
    }
}

TEST(ClockSync, SteadyDriftCostsHardlyMoreThanPerfectClocks) {
    Rig rig(1);
    drift_steadily(rig.world);
    rig.run(60); // 40-bit counters wrap each 17 s
    print("steady drift, 60 s", rig.all);
    EXPECT_GT(rig.all.count, 10900);
    EXPECT_LT(rig.all.ratio(), 1.2);
    EXPECT_NEAR(rig.all.normalised(), 0.95, 0.07);
    EXPECT_LT(rig.all.worst_in_sigma, 5);
    EXPECT_EQ(rig.sync_reasons[Exclusion::innovation_too_large], 0);
}

TEST(ClockSync, WanderingDriftToo) {
    for (const double time_s : {10.0, 30.0, 100.0}) {
        Rig rig(2);
        wander(rig.world, time_s);
        rig.run(60);
        print("wandering drift", rig.all);
        EXPECT_LT(rig.all.ratio(), 1.2) << time_s;
        EXPECT_NEAR(rig.all.normalised(), 1, 0.1) << time_s;
    }
}

TEST(ClockSync, WithoutTheSyncPacketAfterTheBlinkSigmaGrowsAndStaysTrue) {
    Rig rig(3);
    wander(rig.world, 10);
    rig.settings.wait_s = 0;
    rig.run(60);
    print("wandering drift, not waiting", rig.all);
    EXPECT_GT(rig.all.ratio(), 1.5);
    EXPECT_NEAR(rig.all.normalised(), 1, 0.15);
    EXPECT_LT(rig.longest_wait_s, 0.05);
    Rig steady(3);
    drift_steadily(steady.world);
    steady.settings.wait_s = 0;
    steady.settings.crystal_drift_time_s = 1e5;
    steady.run(60);
    print("steady drift, not waiting, told so", steady.all);
    EXPECT_LT(steady.all.ratio(), 1.2);
}

TEST(ClockSync, AThirdOfTheSyncPacketsMayBeLost) {
    Rig rig(4);
    wander(rig.world, 30);
    rig.world.air.sync_loss = 0.3;
    rig.run(60);
    print("30 % of sync packets lost", rig.all);
    EXPECT_LT(rig.all.ratio(), 3);
    EXPECT_NEAR(rig.all.normalised(), 1, 0.15);
    EXPECT_GT(rig.all.count, 10500);
    Rig patient(4);
    wander(patient.world, 30);
    patient.world.air.sync_loss = 0.3;
    patient.settings.wait_s = patient.window_s = 0.5;
    patient.run(60);
    print("30 % of sync packets lost, waiting up to 0.5 s", patient.all);
    EXPECT_LT(patient.all.ratio(), 1.35);
    EXPECT_NEAR(patient.all.normalised(), 1, 0.1);
}

TEST(ClockSync, AChainOfTwoHops) {
    Rig rig(5);
    wander(rig.world, 30);
    rig.world.hears = {{0, 1}, {0, 3}, {1, 2}, {1, 4}}; // 2 and 4 do not hear anchor 0
    rig.run(60);
    print("chain of two hops", rig.all);
    EXPECT_LT(rig.all.ratio(), 1.25);
    EXPECT_NEAR(rig.all.normalised(), 1, 0.1);
    EXPECT_EQ(rig.reasons[Exclusion::impossible_difference], 0);
}

TEST(ClockSync, AMasterThatOnlySendsSyncPacketsWillDo) {
    Rig rig(8);
    drift_steadily(rig.world);
    rig.world.air.deaf = 0;
    rig.run(60);
    print("master hears no blinks", rig.all);
    EXPECT_LT(rig.all.ratio(), 1.3);
    EXPECT_NEAR(rig.all.normalised(), 1, 0.1);
}

TEST(ClockSync, NeitherDelaysNorTheOrderOfInputsChangeADifference) {
    const auto differences = [](double most_delay_s) {
        Rig rig(9);
        rig.world.air.most_delay_s = most_delay_s;
        rig.run(10);
        return rig.values_m;
    };
    const auto in_order = differences(0), shuffled = differences(0.02);
    ASSERT_GT(in_order.size(), 1800u);
    std::size_t alike = 0;
    for (const auto& [key, value_m] : shuffled) {
        const auto found = in_order.find(key);
        if (found != in_order.end() && found->second == value_m) ++alike;
    }
    EXPECT_GT(alike + 8, in_order.size()) << "only the first blinks, before clocks are believed, may differ";
}

TEST(ClockSync, AMasterThatIsStartedAnewMisleadsNobodyAndIsBackWithinASecond) {
    for (const std::size_t restarted : {0u, 1u}) {
        Rig rig(6);
        wander(rig.world, 30);
        rig.run(20);
        rig.longest_gap_s = 0;
        rig.run(40, [&](double time_s) {
            if (std::abs(time_s - 25.05) < step_s / 2) rig.world.crystals[restarted].ticks = 4711;
        });
        print(restarted == 0 ? "master started anew" : "receiver started anew", rig.all);
        EXPECT_LT(rig.all.worst_in_sigma, 5) << "no wrong difference came out";
        EXPECT_NEAR(rig.all.normalised(), 1, 0.1);
        EXPECT_GT(rig.reasons[Exclusion::impossible_difference] + rig.reasons[Exclusion::clock_not_synchronised], 0);
        EXPECT_GT(rig.sync_reasons[Exclusion::clock_jumped], 2);
        EXPECT_LE(rig.sync_reasons[Exclusion::clock_jumped], 4 * 4);
        std::printf("  longest gap %.3f s\n", rig.longest_gap_s);
        EXPECT_LT(rig.longest_gap_s, 1);
    }
}

TEST(ClockSync, StampsOf32BitsThatWrapBetweenTheSyncPackets) {
    Rig rig(7);
    wander(rig.world, 30);
    rig.world.air.clock_bits = rig.settings.clock_bits = 32;
    rig.run(30);
    print("32 bits", rig.all);
    EXPECT_LT(rig.all.ratio(), 1.2);
    EXPECT_NEAR(rig.all.normalised(), 1, 0.1);
}

/// Whatever comes: nothing hangs, nothing leaves that is not finite or lies beyond what the anchors allow, and every
/// arrival is answered for once.
struct Answers final : ClockSynchroniser::Output {
    int given = 0;
    void take(const Measurement& measurement, const AidBook::Record&) noexcept override {
        ++given;
        const auto& d = std::get<RangeDifference>(measurement.observation);
        EXPECT_LE(std::abs(d.difference_m), 30 + 5 * double{d.sigma_m});
        EXPECT_LE(d.sigma_m, 1.1f);
    }
    void judge(const Measurement&, const AidBook::Record&, Exclusion) noexcept override { ++given; }
};

RC_GTEST_PROP(ClockSync, HostileStampsDoNoHarm, ()) {
    Rig rig(10);
    ClockSynchroniser synchroniser(rig.world.site, {}, duration_from_s(0.18));
    Answers answers;
    int kept = 0;
    std::int64_t now_ns = 1'000'000'000;
    const auto stamp = rc::gen::oneOf(rc::gen::arbitrary<std::uint64_t>(), rc::gen::inRange<std::uint64_t>(0, 2000));
    const auto anchor = rc::gen::map(rc::gen::inRange<std::uint64_t>(0, 6), [](std::uint64_t n) { return address(n); });
    for (int i = 0; i < 60; ++i) {
        now_ns += *rc::gen::inRange<std::int64_t>(0, 30'000'000);
        const Timestamp now = timestamp_from_ns(now_ns);
        synchroniser.hear(ClockSync{*anchor, *anchor, *stamp, *stamp, 0}, now);
        Arrival arrival{address(*rc::gen::inRange<std::uint64_t>(0, 5)), address(9), *stamp};
        arrival.sequence = *rc::gen::inRange(0u, 3u);
        if (synchroniser.hear({now, 0, 0, arrival}, {}) == Exclusion::none) ++kept;
        synchroniser.run(now, answers);
    }
    synchroniser.run(timestamp_from_ns(now_ns + 1'000'000'000), answers);
    RC_ASSERT(answers.given == kept);
}

} // namespace
} // namespace locus::clock_test
