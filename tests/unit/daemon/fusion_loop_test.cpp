// The fusion loop: what it promises the real-time thread, and that plans change hands without a gap.
#include "daemon/fusion_loop.h"

#include "drivers/clock.h"
#include "tests/allocations.h"
#include "tests/support/sanitizer.h"
#include "tests/support/socket_client.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <cmath>

namespace locus {
namespace {

EngineSettings hall(unsigned tags) {
    EngineSettings settings;
    for (unsigned i = 0; i < 8; ++i)
        settings.site.anchors.push_back({.name = fmt::format("a{}", i),
                                         .address = address(i),
                                         .position_site_m = {(i & 1) * 10.0, (i >> 1 & 1) * 8.0, (i >> 2) * 3.0}});
    for (unsigned i = 0; i < tags; ++i)
        settings.targets.push_back({.name = fmt::format("t{}", i), .address = address(100 + i), .estimator = {}});
    return settings;
}

std::unique_ptr<FusionPlan> plan_for(const EngineSettings& settings, std::shared_ptr<MeasurementRing> ring) {
    auto plan = std::make_unique<FusionPlan>();
    plan->engine = std::make_unique<Engine>(settings);
    plan->inputs.push_back({std::move(ring), 3});
    plan->generation = 1;
    return plan;
}

void push_ranges(MeasurementRing& ring, const Site& site, Address tag, Timestamp time, std::uint32_t& sequence) {
    const double angle = to_s(time.time_since_epoch());
    const Vec3 at{5 + std::cos(angle), 4 + std::sin(angle), 1};
    for (const Anchor& anchor : site.anchors) {
        const Vec3& a = anchor.position_site_m;
        const double range_m = std::hypot(at[0] - a[0], at[1] - a[1], at[2] - a[2]);
        ring.push({time, sequence++, 0, Range{.anchor = anchor.address, .tag = tag, .range_m = range_m}});
    }
}

long page_faults() {
    rusage usage{};
    ::getrusage(RUSAGE_THREAD, &usage);
    return usage.ru_minflt + usage.ru_majflt;
}

struct Bench {
    explicit Bench(unsigned tags) : settings{hall(tags)}, loop{plan_for(settings, ring), *output, ticked} {}

    /// One tick now, with measurements of every tag at every tenth. Empties the output as the publisher does.
    std::size_t cycle(int number) {
        const Timestamp now = monotonic_now();
        if (number % 10 == 0)
            for (const auto& target : settings.targets)
                push_ranges(*ring, settings.site, target.address, now, sequence);
        loop.cycle(now);
        std::size_t positions = 0;
        for (PoseItem item; output->poses.pop(item);) positions += item.pose.estimate.missing == Missing::nothing;
        for (SourceItem item; output->sources.pop(item);) {
        }
        for (TickItem item; output->ticks.pop(item);) {
        }
        return positions;
    }

    EngineSettings settings;
    std::shared_ptr<MeasurementRing> ring = std::make_shared<MeasurementRing>();
    std::unique_ptr<FusionOutput> output = std::make_unique<FusionOutput>();
    Wake ticked;
    std::uint32_t sequence = 0;
    FusionLoop loop;
};

TEST(FusionLoop, AllocatesNothingAndTouchesNoNewPageOnceItRuns) {
    Bench bench{10};
    // As the daemon does: a snapshot may be used for the first time at any later moment, when a tick comes late.
    const bool locked = ::mlockall(MCL_CURRENT) == 0;
    for (int i = 0; i < 2200; ++i) bench.cycle(i);
    const test::AllocationCount allocations;
    const long faults = page_faults();
    std::size_t positions = 0;
    for (int i = 0; i < 2000; ++i) positions += bench.cycle(i);
    EXPECT_EQ(allocations.made(), 0u);
    const long touched = page_faults() - faults;
    ::munlockall();
    if (locked && !test::under_sanitizer) { // its shadow memory has pages of its own
        EXPECT_EQ(touched, 0);
    }
    EXPECT_EQ(positions, 20'000u) << "else nothing was proved";
}

TEST(FusionLoop, TheCounterCounts) {
    const test::AllocationCount allocations;
    const Bench bench{1};
    EXPECT_GE(allocations.made(), 1u);
}

TEST(FusionLoop, MeasurementsCarryTheirInputsPlaceInTheSettings) {
    Bench bench{1};
    push_ranges(*bench.ring, bench.settings.site, address(100), monotonic_now(), bench.sequence);
    bench.loop.cycle(monotonic_now());
    SourceItem item;
    ASSERT_TRUE(bench.output->sources.pop(item));
    EXPECT_EQ(item.status.input, 3);
    EXPECT_EQ(item.count, 8);
}

TEST(FusionLoop, TicksInTimeOrderAndTakesANewPlanWithoutAGap) {
    Bench bench{1};
    std::jthread thread{[&](const std::stop_token& stop) { bench.loop.run(stop); }};
    Timestamp last{};
    std::uint64_t ticks = 0;
    Generation generation = 0;
    const auto follow_until = [&](auto done) {
        return test::eventually([&] {
            for (TickItem item; bench.output->ticks.pop(item);) {
                EXPECT_GT(item.tick, last);
                EXPECT_EQ(item.ticks, ticks + 1);
                last = item.tick;
                ticks = item.ticks;
                generation = item.generation;
            }
            return done();
        });
    };
    ASSERT_TRUE(follow_until([&] { return ticks > 5; }));
    auto next = plan_for(bench.settings, bench.ring);
    next->generation = 2;
    ASSERT_TRUE(bench.loop.plans.give(next));
    ASSERT_TRUE(follow_until([&] { return generation == 2; }));
    EXPECT_NE(bench.loop.retired.take()->engine, nullptr) << "the old engine came back to be freed here";
    auto same_engine = plan_for(bench.settings, bench.ring);
    same_engine->generation = 3;
    same_engine->engine.reset();
    ASSERT_TRUE(bench.loop.plans.give(same_engine));
    ASSERT_TRUE(follow_until([&] { return generation == 3; }));
    EXPECT_EQ(bench.loop.retired.take()->engine, nullptr) << "the engine stayed";
}

TEST(FusionLoop, StalledItShowsNoLifeAndStillStops) {
    Bench bench{1};
    std::jthread thread{[&](const std::stop_token& stop) { bench.loop.run(stop); }};
    ASSERT_TRUE(test::eventually([&] { return bench.loop.heartbeat() > 3; }));
    bench.loop.stall();
    ASSERT_TRUE(test::eventually([&] {
        const auto before = bench.loop.heartbeat();
        std::this_thread::sleep_for(std::chrono::milliseconds{150});
        return bench.loop.heartbeat() == before;
    }));
}

TEST(TickSchedule, TicksAreMultiplesOfThePeriodAndMissedOnesAreLeftOut) {
    TickSchedule schedule{Duration{10}};
    const auto at = [](std::int64_t ns) { return timestamp_from_ns(ns); };
    EXPECT_EQ(schedule.next(at(101)), at(110));
    EXPECT_EQ(schedule.next(at(103)), at(120)) << "never the same twice";
    EXPECT_EQ(schedule.next(at(157)), at(160)) << "130 to 150 were missed";
    schedule.set_period(Duration{7});
    EXPECT_EQ(schedule.next(at(158)), at(161)) << "after a reload: multiples of the new one";
}

} // namespace
} // namespace locus
