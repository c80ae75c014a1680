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

EngineSettings short_memory(EngineSettings settings) {
    settings.fusion.window_s = window_s;
    settings.fusion.lost_after_s = 0.15; // so that fresh starts happen too
    return settings;
}

EngineSettings with_follower() { return short_memory(follower_settings()); }

EngineSettings with_range_ekf() {
    auto settings = short_memory(follower_settings());
    settings.fusion.estimator = "range_ekf";
    return settings;
}

EngineSettings with_inertial_ekf() {
    auto settings = short_memory(follower_settings());
    settings.fusion.estimator = "inertial_ekf";
    return settings;
}

/// Often none, often as late as just counts.
rc::Gen<int> delay_ms() {
    using namespace rc;
    return gen::oneOf(gen::just(0), gen::inRange(0, 201), gen::inRange(195, 201));
}

double distance_m(const Vec3& a, const Vec3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

/// What an anchor sees of a tag that walks in a circle; now and then it is far off, so that some are refused.
Observation seen(const EngineSettings& settings, double time_s, std::size_t anchor, std::uint64_t tag, int noise) {
    const Vec3 position_m{5 + 2 * std::sin(time_s), 4 + 2 * std::cos(time_s), 1.2};
    const double error_m = noise < 95 ? 0.002 * (noise - 47) : 8;
    const std::size_t other = (anchor + 1) % settings.site.anchors.size();
    const double here_m = distance_m(position_m, settings.site.anchors[anchor].position_site_m);
    const double there_m = distance_m(position_m, settings.site.anchors[other].position_site_m);
    if (noise % 4 == 0)
        return RangeDifference{address(anchor), address(other), address(tag), there_m - here_m + error_m, unknown_f};
    return Range{address(anchor), address(tag), here_m + error_m};
}

/// What a tag with more sensors tells besides: now and then a sample of another kind.
Observation told(const EngineSettings& settings, double time_s, std::size_t anchor, std::uint64_t tag, int noise) {
    if (settings.fusion.estimator != "inertial_ekf" || noise % 3 != 0)
        return seen(settings, time_s, anchor, tag, noise);
    if (noise % 9 == 0) return Height{address(tag), 1.2 + 0.001 * noise, unknown_f};
    if (noise % 9 == 3) return WheelSpeed{address(tag), 2 + 0.01 * noise};
    return ImuSample{address(tag), {-2 * std::sin(time_s), -2 * std::cos(time_s), 9.8}, {0, 0, 0.001 * noise}};
}

/// Times fall on a grid of 1 ms, so some samples share one.
rc::Gen<Arriving> arriving(const EngineSettings& settings) {
    using namespace rc;
    return gen::map(gen::tuple(gen::inRange(0, 1000), delay_ms(), gen::inRange(0, 4), gen::inRange(0, 4),
                               gen::inRange(100, 102), gen::inRange(0, 100)),
                    [&settings](const std::tuple<int, int, int, int, int, int>& numbers) {
                        const auto [time_ms, delay, input, anchor, tag, noise] = numbers;
                        const auto observation = told(settings, 0.001 * time_ms, static_cast<std::size_t>(anchor),
                                                      static_cast<std::uint64_t>(tag), noise);
                        return Arriving{{at(0.001 * time_ms), 0, static_cast<std::uint16_t>(input), observation},
                                        at(0.001 * (time_ms + delay))};
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

/// How many poses there were that held a position.
long check_every_tick(const EngineSettings& settings, const std::vector<Arriving>& all) {
    Engine engine(settings);
    std::size_t arrived = 0;
    long positions = 0;
    for (double tick = tick_s; tick < run_s + window_s + tick_s; tick += tick_s) {
        for (; arrived < all.size() && all[arrived].arrival <= at(tick); ++arrived) {
            engine.submit(all[arrived].measurement, all[arrived].arrival);
            if (arrived % 5 == 0) engine.submit(all[arrived].measurement, all[arrived].arrival); // comes twice
        }
        const auto poses = engine.step(at(tick));
        expect_same(poses, in_order(settings, std::span(all).first(arrived), at(tick)));
        positions +=
            std::ranges::count_if(poses, [](const Pose& pose) { return pose.estimate.missing == Missing::nothing; });
    }
    RC_ASSERT(engine.counters().late == 0u);
    return positions;
}

void feed(Engine& engine, const std::vector<Arriving>& all, Timestamp (*when)(const Arriving&)) {
    std::size_t i = 0;
    for (double tick = tick_s; tick < run_s + window_s + tick_s; tick += tick_s) {
        for (; i < all.size() && when(all[i]) <= at(tick); ++i) engine.submit(all[i].measurement, when(all[i]));
        engine.step(at(tick));
    }
}

void expect_same_counters(const Engine& a, const Engine& b) {
    RC_ASSERT(a.counters().by_reason == b.counters().by_reason);
    for (std::size_t i = 0; i < a.settings().site.anchors.size(); ++i) {
        const AidStatus &one = a.sources()[i], &other = b.sources()[i];
        RC_ASSERT(std::tie(one.counters.received, one.counters.used, one.counters.refused) ==
                  std::tie(other.counters.received, other.counters.used, other.counters.refused));
        RC_ASSERT(one.last_time == other.last_time);
    }
}

class EngineOrder : public testing::TestWithParam<EngineSettings (*)()> {};

TEST_P(EngineOrder, PosesAreThoseOfInOrderArrivalAtEveryTick) {
    const auto settings = GetParam()();
    long positions = 0;
    EXPECT_TRUE(rc::check([&] {
        const auto size = *rc::gen::inRange<std::size_t>(0, 200);
        positions += check_every_tick(settings,
                                      by_arrival(*rc::gen::container<std::vector<Arriving>>(size, arriving(settings))));
    }));
    EXPECT_GT(positions, 200); // there was something to compare; chance gives about a thousand
}

TEST_P(EngineOrder, CountersDoNotKnowTheOrderEither) {
    const auto settings = GetParam()();
    EXPECT_TRUE(rc::check([&] {
        auto all = by_arrival(*rc::gen::container<std::vector<Arriving>>(80, arriving(settings)));
        Engine shuffled(settings), sorted(settings);
        feed(shuffled, all, [](const Arriving& each) { return each.arrival; });
        std::stable_sort(all.begin(), all.end(),
                         [](const Arriving& a, const Arriving& b) { return a.measurement.time < b.measurement.time; });
        feed(sorted, all, [](const Arriving& each) { return each.measurement.time; });
        RC_ASSERT(sorted.counters().rolled_back == 0u);
        expect_same_counters(shuffled, sorted);
    }));
}

std::string name_of(const testing::TestParamInfo<EngineSettings (*)()>& info) { return info.param().fusion.estimator; }

INSTANTIATE_TEST_SUITE_P(Of, EngineOrder, testing::Values(with_follower, with_range_ekf, with_inertial_ekf), name_of);

} // namespace
} // namespace locus::engine_test
