// What the engine costs: a second of a site in which every tag hears 8 anchors 10 times a second and every pose is
// wanted 100 times a second. `cpu_share` is the part of one core that this takes; `late` is what a roll-back adds when
// every other sweep comes a tick and a half late.
#include "fusion/engine.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using namespace locus;

constexpr double sweep_s = 0.1;
constexpr double tick_s = 0.01;
constexpr int sweeps_in_run = 50;

Timestamp at(double time_s) { return timestamp_from_s(time_s); }

EngineSettings hall(int tags) {
    EngineSettings settings;
    settings.fusion.max_targets = tags;
    settings.fusion.max_measurement_rate_hz = 200;
    for (std::uint64_t i = 0; i < 8; ++i) {
        Anchor anchor;
        anchor.address = address(i);
        anchor.position_site_m = {i & 1 ? 20.0 : 0.0, i & 2 ? 15.0 : 0.0, i & 4 ? 5.0 : 0.5};
        settings.site.anchors.push_back(anchor);
    }
    return settings;
}

struct Arriving {
    Measurement measurement;
    Timestamp arrival;
};

/// One sweep over all tags and anchors; tags do not all speak at once.
void add_sweep(std::vector<Arriving>& all, const Site& site, int tags, int sweep, double late_s) {
    for (int tag = 0; tag < tags; ++tag) {
        const double time_s = sweep_s * (sweep + static_cast<double>(tag) / tags);
        const Vec3 p{10 + 5 * std::sin(0.2 * time_s + tag), 7 + 5 * std::cos(0.2 * time_s + tag), 1.5};
        for (std::size_t i = 0; i < site.anchors.size(); ++i) {
            const Vec3& a = site.anchors[i].position_site_m;
            const double noise_m = 0.05 * std::sin(1e3 * time_s + 7.0 * static_cast<double>(i));
            const Range range{address(i), address(100u + static_cast<unsigned>(tag)),
                              std::hypot(p[0] - a[0], p[1] - a[1], p[2] - a[2]) + noise_m};
            all.push_back({{at(time_s), static_cast<std::uint32_t>(all.size()), 0, range}, at(time_s + late_s)});
        }
    }
}

std::vector<Arriving> measurements(const Site& site, int tags, double late_s) {
    std::vector<Arriving> all;
    for (int sweep = 0; sweep < sweeps_in_run; ++sweep) add_sweep(all, site, tags, sweep, sweep % 2 == 0 ? late_s : 0);
    std::stable_sort(all.begin(), all.end(),
                     [](const Arriving& a, const Arriving& b) { return a.arrival < b.arrival; });
    return all;
}

void engine_second(benchmark::State& state, double late_s) {
    const auto tags = static_cast<int>(state.range(0));
    const EngineSettings settings = hall(tags);
    const auto all = measurements(settings.site, tags, late_s);
    double engine_s = 0;
    for (auto _ : state) {
        state.PauseTiming();
        Engine engine(settings);
        state.ResumeTiming();
        std::size_t i = 0;
        for (int tick = 1; tick <= 10 * sweeps_in_run; ++tick) {
            for (; i < all.size() && all[i].arrival <= at(tick * tick_s); ++i)
                engine.submit(all[i].measurement, all[i].arrival);
            benchmark::DoNotOptimize(engine.step(at(tick * tick_s)).data());
        }
        engine_s += sweep_s * sweeps_in_run;
        if (engine.counters().used * 10 < engine.counters().received * 9) state.SkipWithError("too few were used");
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
    state.counters["cpu_share"] =
        benchmark::Counter(engine_s, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(engine_second, in_time, 0.0)->Arg(10)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(engine_second, late, 0.115)->Arg(10)->Arg(1000)->Unit(benchmark::kMillisecond);

/// A tick with nothing new: the prediction of every pose.
void engine_idle_tick(benchmark::State& state) {
    const auto tags = static_cast<int>(state.range(0));
    const EngineSettings settings = hall(tags);
    Engine engine(settings);
    auto tick = at(0);
    for (const auto& each : measurements(settings.site, tags, 0)) {
        engine.submit(each.measurement, each.arrival);
        if (each.arrival >= tick + duration_from_s(tick_s)) engine.step(tick = each.arrival);
    }
    tick = at(sweep_s * sweeps_in_run);
    for (auto _ : state) benchmark::DoNotOptimize(engine.step(tick += Duration{1000}).data());
    state.SetItemsProcessed(state.iterations() * tags);
}
BENCHMARK(engine_idle_tick)->Arg(10)->Arg(1000)->Unit(benchmark::kMicrosecond);

} // namespace
