// Crystals 20 ppm apart that drift by 0.1 ppm/s, sync packets each 150 ms, arrival stamps 150 ps off: range differences
// must be hardly worse than perfect clocks would make them, and their sigma must be true.
#include "fusion/uwb/clock_sync/synchroniser.h"
#include "tests/unit/fusion/uwb/clock_sync/simulated_clocks.h"

#include <gtest/gtest.h>

#include <map>
#include <queue>

namespace locus::clock_test {
namespace {

using uwb::ClockSynchroniser;

const std::vector<Vec3> hall{{0, 0, 3}, {20, 0, 2.5}, {20, 12, 3}, {0, 12, 2.5}, {10, 6, 5}};

struct Tally {
    double squares_m2 = 0, perfect_squares_m2 = 0, normalised_squares = 0, worst_in_sigma = 0;
    int count = 0;

    double rms_m() const { return std::sqrt(squares_m2 / count); }
    double ratio() const { return std::sqrt(squares_m2 / perfect_squares_m2); }
    double normalised() const { return normalised_squares / count; }
};

/// Delivers messages to a synchroniser in the order in which they reach the host, and weighs what comes out.
struct Rig final : ClockSynchroniser::Output {
    SimulatedAnchors world;
    ClockSyncSettings settings;
    std::map<Exclusion, int> reasons; ///< of arrivals
    std::map<Exclusion, int> sync_reasons;
    Tally all;
    std::map<std::pair<std::int64_t, std::size_t>, double> values_m; ///< by blink and anchor
    double count_from_s = 5;
    double last_good_s = 0;
    double longest_gap_s = 0;
    double window_s = 0.19;
    double longest_wait_s = 0;

    /// Everybody hears anchor 0.
    explicit Rig(unsigned seed) : world(seed) {
        world.place(hall);
        world.everyone_hears(0);
        world.send = [this](const Message& message) { on_the_way.push(message); };
        world.tag_position = [](double t) {
            return Eigen::Vector3d(10 + 8 * std::cos(t / 3), 6 + 4 * std::sin(t / 2), 1);
        };
    }

    void run(double until_s, const std::function<void(double)>& meddle = [](double) {}) {
        if (!synchroniser) synchroniser.emplace(world.site, settings, duration_from_s(window_s));
        while (world.time_s() < until_s) {
            world.step();
            meddle(world.time_s());
            const double now_s = 100 + world.time_s();
            for (; !on_the_way.empty() && on_the_way.top().host_s <= now_s; on_the_way.pop())
                hand_over(on_the_way.top().measurement);
            if (std::llround(world.time_s() / step_s) % 10 == 0) {
                tick_s = now_s;
                synchroniser->run(timestamp_from_s(now_s), *this);
            }
        }
    }

    Rig(const Rig&) = delete;
    Rig& operator=(const Rig&) = delete;

    void hand_over(const Measurement& measurement) {
        if (const auto* packet = std::get_if<ClockSync>(&measurement.observation))
            ++sync_reasons[synchroniser->hear(*packet, measurement.time).reason];
        else if (const auto reason = synchroniser->hear(measurement, {}); reason != Exclusion::none)
            ++reasons[reason];
    }

    void take(const Measurement& measurement, const AidBook::Record&) noexcept override {
        ++reasons[Exclusion::none];
        const auto& d = std::get<RangeDifference>(measurement.observation);
        EXPECT_EQ(d.tag, address(9));
        const std::size_t a = number(d.anchor_a), b = number(d.anchor_b);
        const auto& blink = blink_of(measurement);
        values_m[{blink.number, b}] = d.difference_m;
        const auto to = [&](std::size_t i) {
            return (vector(world.site.anchors[i].position_site_m) - blink.position).norm();
        };
        const double true_m = to(b) - to(a), error_m = d.difference_m - true_m;
        longest_wait_s = std::max(longest_wait_s, tick_s - to_s(measurement.time));
        longest_gap_s = std::max(longest_gap_s, to_s(measurement.time) - last_good_s);
        last_good_s = to_s(measurement.time);
        if (world.time_s() < count_from_s) return;
        ++all.count;
        all.squares_m2 += error_m * error_m;
        all.perfect_squares_m2 += std::pow(blink.noise_m[b] - blink.noise_m[a], 2);
        all.normalised_squares += std::pow(error_m / double{d.sigma_m}, 2);
        all.worst_in_sigma = std::max(all.worst_in_sigma, std::abs(error_m) / double{d.sigma_m});
    }
    void judge(const Measurement&, const AidBook::Record&, Exclusion reason) noexcept override { ++reasons[reason]; }

  private:
    struct Later {
        bool operator()(const Message& a, const Message& b) const { return a.host_s > b.host_s; }
    };
    struct TrueBlink {
        std::int64_t number;
        Eigen::Vector3d position;
        std::vector<double> noise_m;
    };
    std::priority_queue<Message, std::vector<Message>, Later> on_the_way;
    std::optional<ClockSynchroniser> synchroniser;
    double tick_s = 0;

    /// By its time: blinks come at regular intervals, and longer ones than messages are late by.
    TrueBlink blink_of(const Measurement& measurement) const {
        const double sent_s = to_s(measurement.time) - 100 - world.air.most_delay_s / 2;
        const double since_first_s = sent_s - 0.002 + world.air.blink_interval_s / 2;
        const auto number = static_cast<std::int64_t>(std::floor(since_first_s / world.air.blink_interval_s));
        TrueBlink blink{number, world.position_of_blink(static_cast<std::uint32_t>(number & 0xFF)), {}};
        for (std::size_t i = 0; i < world.site.anchors.size(); ++i)
            blink.noise_m.push_back(world.noise_between_m(0, i, static_cast<std::uint32_t>(number & 0xFF)));
        return blink;
    }
};

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

} // namespace
} // namespace locus::clock_test
