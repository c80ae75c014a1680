// What wireless clock synchronisation costs: one sync packet into its link, and one blink that eight anchors heard,
// from its arrivals to its range differences.
#include "fusion/uwb/clock_sync/synchroniser.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace {

using namespace locus;

constexpr std::uint64_t anchors = 8;

Site ring() {
    Site site;
    for (std::uint64_t i = 0; i < anchors; ++i) {
        const double turn = 0.785 * static_cast<double>(i);
        site.anchors.push_back({"", address(i), {10 * std::cos(turn), 10 * std::sin(turn), 3}});
    }
    return site;
}

/// All clocks perfect and the distances between anchors nothing: what it costs does not depend on either.
std::uint64_t ticks(double time_s) { return static_cast<std::uint64_t>(time_s / uwb::tick_s); }

void sync(uwb::ClockSynchroniser& clocks, double time_s) {
    for (std::uint64_t i = 1; i < anchors; ++i)
        benchmark::DoNotOptimize(
            clocks.hear(ClockSync{address(0), address(i), ticks(time_s), ticks(time_s), 0}, timestamp_from_s(time_s)));
}

struct Count final : uwb::ClockSynchroniser::Output {
    std::int64_t differences = 0;
    void take(const Measurement& /*difference*/, const AidBook::Record& /*record*/) noexcept override { ++differences; }
    void judge(const Measurement& /*arrival*/, const AidBook::Record& /*record*/,
               Exclusion /*reason*/) noexcept override {}
};

void sync_packets(benchmark::State& state) {
    const Site site = ring();
    uwb::ClockSynchroniser clocks(site, {}, duration_from_s(0.18));
    double time_s = 0;
    for (auto _ : state) sync(clocks, time_s += 0.15);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(anchors - 1));
}
BENCHMARK(sync_packets);

void blinks(benchmark::State& state) {
    const Site site = ring();
    ClockSyncSettings settings;
    settings.wait_s = 0;
    uwb::ClockSynchroniser clocks(site, settings, duration_from_s(0.18));
    for (int i = 0; i < 20; ++i) sync(clocks, 0.15 * i);
    Count count;
    std::uint32_t sequence = 0;
    for (auto _ : state) {
        for (std::uint64_t i = 0; i < anchors; ++i) {
            Arrival arrival{address(i), address(9), ticks(2.9)};
            arrival.sequence = sequence;
            benchmark::DoNotOptimize(clocks.hear({timestamp_from_s(2.9), sequence, 0, arrival}, {}));
        }
        ++sequence;
        clocks.run(timestamp_from_s(3), count);
    }
    if (count.differences == 0) state.SkipWithError("no differences came out");
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(anchors));
}
BENCHMARK(blinks);

} // namespace
