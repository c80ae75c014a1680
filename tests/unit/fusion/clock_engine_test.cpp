// Raw arrivals and sync packets through the whole engine: a tag is followed about as well as by range differences that
// perfect clocks give, and whoever is left out is told why.
#include "fusion/engine.h"
#include "tests/allocations.h"
#include "tests/unit/fusion/uwb/clock_sync/simulated_clocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace locus::clock_test {
namespace {

Timestamp host(double time_s) { return timestamp_from_s(100 + time_s); }

/// A hall with six anchors of which the first is the master, a walker at 1.6 m/s at most, crystals that drift.
SimulatedAnchors hall_with_walker(unsigned seed) {
    SimulatedAnchors world(seed);
    world.place({{0, 0, 3}, {20, 0, 1}, {20, 12, 3}, {0, 12, 1}, {10, 0, 4}, {10, 12, 2}});
    world.everyone_hears(0);
    world.air.blink_interval_s = 0.1;
    for (auto& crystal : world.crystals) {
        crystal.wander_per_s = 1e-7;
        crystal.wander_time_s = 30;
    }
    world.tag_position = [](double t) {
        return Eigen::Vector3d(10 + 6 * std::cos(t / 6), 6 + 4 * std::sin(t / 4), 1.2);
    };
    return world;
}

EngineSettings settings_of(const SimulatedAnchors& world) {
    EngineSettings settings;
    settings.site = world.site;
    settings.fusion.max_targets = 2;
    return settings;
}

using Look = std::function<void(const Pose&, double time_s)>;
using Change = std::function<std::optional<Message>(const Message&)>;

void look_away(const Pose& /*pose*/, double /*time_s*/) {}
std::optional<Message> as_it_is(const Message& message) { return message; }

/// Runs the world to its time, ticks the engine at 100 Hz.
void run(SimulatedAnchors& world, Engine& engine, double until_s, const Look& look = look_away,
         const Change& change = as_it_is) {
    std::vector<Message> waiting;
    world.send = [&](const Message& message) {
        if (const auto changed = change(message)) waiting.push_back(*changed);
    };
    while (world.time_s() < until_s) {
        world.step();
        std::erase_if(waiting, [&](const Message& message) {
            if (message.host_s > 100 + world.time_s()) return false;
            engine.submit(message.measurement, host(world.time_s()));
            return true;
        });
        if (std::llround(world.time_s() / step_s) % 10 != 0) continue;
        for (const Pose& pose : engine.step(host(world.time_s()))) look(pose, world.time_s());
    }
}

struct Errors {
    double squares_m2 = 0;
    int count = 0, missing = 0;
    double rms_m() const { return std::sqrt(squares_m2 / count); }
};

Errors errors_of(SimulatedAnchors& world, Engine& engine, double until_s, const Change& change = as_it_is) {
    Errors errors;
    const auto look = [&](const Pose& pose, double time_s) {
        if (time_s < 5) return;
        if (pose.estimate.missing != Missing::nothing) {
            ++errors.missing;
            return;
        }
        const Eigen::Vector3d off = vector(pose.estimate.position_site_m) - world.tag_position(time_s);
        errors.squares_m2 += off.head<2>().squaredNorm();
        ++errors.count;
    };
    run(world, engine, until_s, look, change);
    return errors;
}

/// What the arrival would be worth if all clocks were one: the same noise, as a difference against anchor 0.
Measurement perfect_difference(const SimulatedAnchors& world, const Measurement& measurement, std::size_t b) {
    const auto& arrival = std::get<Arrival>(measurement.observation);
    const Eigen::Vector3d tag = world.position_of_blink(arrival.sequence);
    const auto to = [&](std::size_t i) { return (vector(world.site.anchors[i].position_site_m) - tag).norm(); };
    Measurement difference = measurement;
    difference.time = host(world.time_s());
    difference.observation = RangeDifference{address(0), arrival.anchor, arrival.tag,
                                             to(b) - to(0) + world.noise_between_m(0, b, arrival.sequence), 0.0636f};
    return difference;
}

/// As run(), but with differences of perfect clocks in place of arrivals, that late.
Errors errors_with_perfect_clocks(unsigned seed, double delay_s, double until_s) {
    SimulatedAnchors world = hall_with_walker(seed);
    Engine engine(settings_of(world));
    const auto replaced = [&](const Message& message) -> std::optional<Message> {
        const auto* arrival = std::get_if<Arrival>(&message.measurement.observation);
        if (!arrival || arrival->anchor == address(0)) return std::nullopt;
        return Message{100 + world.time_s() + delay_s,
                       perfect_difference(world, message.measurement, number(arrival->anchor))};
    };
    return errors_of(world, engine, until_s, replaced);
}

TEST(ClockEngine, FollowsATagAsRangeDifferencesOfPerfectClocksDo) {
    SimulatedAnchors world = hall_with_walker(11);
    Engine engine(settings_of(world));
    const Errors ours = errors_of(world, engine, 60);
    const Errors at_once = errors_with_perfect_clocks(11, 0.002, 60), waiting = errors_with_perfect_clocks(11, 0.1, 60);
    std::printf(
        "horizontal error: %.4f m; of perfect clocks, 0.1 s late as these: %.4f m, ratio %.3f; at once: %.4f m\n",
        ours.rms_m(), waiting.rms_m(), ours.rms_m() / waiting.rms_m(), at_once.rms_m());
    EXPECT_EQ(ours.missing + waiting.missing + at_once.missing, 0);
    EXPECT_EQ(ours.count, waiting.count);
    EXPECT_LT(ours.rms_m(), 0.1);
    EXPECT_LT(ours.rms_m(), 1.4 * waiting.rms_m());
}

TEST(ClockEngine, EveryMessageIsAccountedForOnce) {
    SimulatedAnchors world = hall_with_walker(12);
    Engine engine(settings_of(world));
    run(world, engine, 20);
    world.air.blink_interval_s = world.air.sync_interval_s = 1000;
    run(world, engine, 21);
    const EngineCounters& c = engine.counters();
    EXPECT_EQ(c.received, c.used + c.late + c.refused);
    EXPECT_EQ(c.late, 0u);
    EXPECT_GT(c.used, c.refused * 10);
    EXPECT_GT(c.by_reason[static_cast<std::size_t>(Exclusion::clock_not_synchronised)], 0u) << "in the first second";
    for (const AidStatus& source : engine.sources()) {
        EXPECT_EQ(source.counters.received, source.counters.used + source.counters.refused);
        EXPECT_EQ(source.last_verdict.reason, Exclusion::none) << number(source.source);
    }
}

TEST(ClockEngine, AnAnchorThatNoSyncPacketReachesIsToldSoAndTheOthersGoOn) {
    SimulatedAnchors world = hall_with_walker(13);
    std::erase_if(world.hears, [](const auto& link) { return link.second == 3; });
    Engine engine(settings_of(world));
    const Errors errors = errors_of(world, engine, 20);
    EXPECT_EQ(errors.missing, 0);
    EXPECT_EQ(engine.sources()[3].last_verdict.reason, Exclusion::clock_not_synchronised);
    EXPECT_EQ(engine.sources()[3].counters.used, 0u);
    EXPECT_EQ(engine.sources()[2].last_verdict.reason, Exclusion::none);
}

TEST(ClockEngine, ASyncPacketOfAStrangerSynchronisesNobody) {
    SimulatedAnchors world = hall_with_walker(14);
    EngineSettings settings = settings_of(world);
    settings.site.anchors.erase(settings.site.anchors.begin());
    Engine engine(settings);
    run(world, engine, 3);
    const auto strangers = std::count_if(engine.sources().begin(), engine.sources().end(), [](const AidStatus& source) {
        return source.last_verdict.reason == Exclusion::unknown_source;
    });
    EXPECT_EQ(strangers, 1);
    EXPECT_EQ(engine.sources()[0].last_verdict.reason, Exclusion::clock_not_synchronised);
    EXPECT_TRUE(engine.step(host(3.5)).empty()) << "nothing was heard of a tag that could be used";
}

TEST(ClockEngine, AllocatesNothingAfterConstruction) {
    SimulatedAnchors world = hall_with_walker(15);
    std::vector<Message> messages;
    world.send = [&](const Message& message) { messages.push_back(message); };
    while (world.time_s() < 10) world.step();
    std::sort(messages.begin(), messages.end(), [](const auto& a, const auto& b) { return a.host_s < b.host_s; });
    Engine engine(settings_of(world));
    const test::AllocationCount allocations;
    double tick_s = 100;
    for (const Message& message : messages) {
        engine.submit(message.measurement, timestamp_from_s(message.host_s));
        for (; tick_s < message.host_s; tick_s += 0.01) engine.step(timestamp_from_s(tick_s));
    }
    EXPECT_EQ(allocations.made(), 0u);
    EXPECT_GT(engine.counters().used, 800u);
}

} // namespace
} // namespace locus::clock_test
