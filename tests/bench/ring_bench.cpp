// Throughput of the ring between two threads, Measurement-sized items.
#include "fusion/measurement.h"
#include "fusion/ring.h"

#include <benchmark/benchmark.h>

#include <atomic>
#include <memory>
#include <thread>

static void ring_two_threads(benchmark::State& state) {
    auto ring = std::make_unique<locus::Ring<locus::Measurement, 1024>>();
    std::atomic<bool> stop{false};
    std::thread consumer([&] {
        locus::Measurement item;
        while (!stop.load(std::memory_order_relaxed)) benchmark::DoNotOptimize(ring->pop(item));
    });
    const locus::Measurement item{};
    for (auto _ : state)
        while (!ring->push(item)) {
        }
    stop = true;
    consumer.join();
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(ring_two_threads)->UseRealTime();
