// The order of arrival does not matter: at every tick the pose is, to the bit, what an engine gives that got exactly
// the measurements that have come by then, each at its own time.
#include "tests/unit/fusion/engine_fixture.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <tuple>

namespace locus::engine_test {
namespace {

constexpr double window_s = 0.2;
constexpr double tick_s = 0.02;
constexpr double run_s = 1;

struct Arriving {
    Measurement measurement;
    Timestamp arrival;
};

EngineSettings short_memory() {
    auto settings = follower_settings();
    settings.fusion.window_s = window_s;
    settings.fusion.lost_after_s = 0.05; // so that fresh starts happen too
    return settings;
}

/// Often none, often as late as just counts.
rc::Gen<int> delay_ms() {
    using namespace rc;
    return gen::oneOf(gen::just(0), gen::inRange(0, 201), gen::inRange(195, 201));
}

/// Times fall on a grid of 1 ms, so some samples share one; now and then the value jumps, so some are refused.
rc::Gen<Arriving> arriving() {
    using namespace rc;
    return gen::map(gen::tuple(gen::inRange(0, 1000), delay_ms(), gen::inRange(0, 4), gen::inRange(0, 4),
                               gen::inRange(100, 102), gen::inRange(0, 100)),
                    [](const std::tuple<int, int, int, int, int, int>& numbers) {
                        const auto [time_ms, delay_ms, input, anchor, tag, value] = numbers;
                        const double value_m = value < 80 ? 5 + 0.01 * value : 30;
                        auto measurement = range(0.001 * time_ms, value_m, 0, static_cast<std::uint64_t>(anchor),
                                                 static_cast<std::uint64_t>(tag));
                        measurement.input = static_cast<std::uint16_t>(input);
                        return Arriving{measurement, at(0.001 * (time_ms + delay_ms))};
                    });
}

std::vector<Arriving> by_arrival(std::vector<Arriving> all) {
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i].measurement.sequence = i;
    std::stable_sort(all.begin(), all.end(),
                     [](const Arriving& a, const Arriving& b) { return a.arrival < b.arrival; });
    return all;
}

/// What an engine gives at `tick` that got the first `count` of `all`, each at its own time and in order of time.
std::vector<Pose> in_order(const EngineSettings& settings, std::span<const Arriving> arrived, Timestamp tick) {
    std::vector<Arriving> sorted(arrived.begin(), arrived.end());
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Arriving& a, const Arriving& b) { return a.measurement.time < b.measurement.time; });
    auto long_memory = settings;
    long_memory.fusion.window_s = 5;
    Engine engine(long_memory);
    for (const Arriving& each : sorted) engine.submit(each.measurement, each.measurement.time);
    const auto poses = engine.step(tick);
    return {poses.begin(), poses.end()};
}

void expect_same(std::span<const Pose> poses, const std::vector<Pose>& expected) {
    for (const Pose& pose : poses) {
        const auto twin = std::find_if(expected.begin(), expected.end(),
                                       [&](const Pose& other) { return other.target == pose.target; });
        RC_ASSERT(twin != expected.end());
        RC_ASSERT(same_bits(pose.estimate, twin->estimate));
    }
}

void check_every_tick(const EngineSettings& settings, const std::vector<Arriving>& all) {
    Engine engine(settings);
    std::size_t arrived = 0;
    for (double tick = tick_s; tick < run_s + window_s + tick_s; tick += tick_s) {
        for (; arrived < all.size() && all[arrived].arrival <= at(tick); ++arrived) {
            engine.submit(all[arrived].measurement, all[arrived].arrival);
            if (arrived % 5 == 0) engine.submit(all[arrived].measurement, all[arrived].arrival); // comes twice
        }
        expect_same(engine.step(at(tick)), in_order(settings, std::span(all).first(arrived), at(tick)));
    }
    RC_ASSERT(engine.counters().late == 0u);
    RC_TAG(engine.counters().rolled_back > 0);
}

TEST(EngineOrder, PosesAreThoseOfInOrderArrivalAtEveryTick) {
    const auto settings = short_memory();
    EXPECT_TRUE(rc::check([&] {
        const auto size = *rc::gen::inRange<std::size_t>(0, 120);
        check_every_tick(settings, by_arrival(*rc::gen::container<std::vector<Arriving>>(size, arriving())));
    }));
}

/// Counters of two engines that got the same measurements, one in order and one not.
TEST(EngineOrder, CountersDoNotKnowTheOrderEither) {
    const auto settings = short_memory();
    EXPECT_TRUE(rc::check([&] {
        auto all = by_arrival(*rc::gen::container<std::vector<Arriving>>(80, arriving()));
        Engine shuffled(settings), sorted(settings);
        const auto feed = [](Engine& engine, const std::vector<Arriving>& list, auto when) {
            std::size_t i = 0;
            for (double tick = tick_s; tick < run_s + window_s + tick_s; tick += tick_s) {
                for (; i < list.size() && when(list[i]) <= at(tick); ++i)
                    engine.submit(list[i].measurement, when(list[i]));
                engine.step(at(tick));
            }
        };
        feed(shuffled, all, [](const Arriving& each) { return each.arrival; });
        std::stable_sort(all.begin(), all.end(),
                         [](const Arriving& a, const Arriving& b) { return a.measurement.time < b.measurement.time; });
        feed(sorted, all, [](const Arriving& each) { return each.measurement.time; });
        RC_ASSERT(shuffled.counters().by_reason == sorted.counters().by_reason);
        RC_ASSERT(sorted.counters().rolled_back == 0u);
        for (std::size_t i = 0; i < 4; ++i) {
            const AidStatus &a = shuffled.sources()[i], &b = sorted.sources()[i];
            RC_ASSERT(std::tie(a.counters.received, a.counters.used, a.counters.refused) ==
                      std::tie(b.counters.received, b.counters.used, b.counters.refused));
            RC_ASSERT(a.last_time == b.last_time);
        }
    }));
}

} // namespace
} // namespace locus::engine_test
