// Frames and bytes a second of each decoder, fed as a transport would: chunks of 256 bytes, or one CAN frame a call.
#include "drivers/uwb/dw1000_can.h"
#include "drivers/uwb/robomaster_can.h"
#include "drivers/uwb/trek1000.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <vector>

namespace {

using namespace locus;

struct CountingSink : MeasurementSink {
    std::int64_t measurements = 0, frames = 0, refusals = 0;
    void accept(Timestamp, const Observation& observation) override {
        benchmark::DoNotOptimize(&observation);
        ++measurements;
    }
    void frame() override { ++frames; }
    void refuse(Refusal) override { ++refusals; }
};

std::vector<Packet> chunks(std::span<const std::uint8_t> bytes) {
    std::vector<Packet> packets;
    for (std::size_t at = 0; at < bytes.size(); at += 256) {
        Packet packet;
        packet.data = bytes.subspan(at, std::min<std::size_t>(256, bytes.size() - at));
        packets.push_back(packet);
    }
    return packets;
}

std::vector<Packet> packets_of(const std::vector<CanFrame>& frames) {
    std::vector<Packet> packets;
    for (const CanFrame& frame : frames) packets.push_back(frame.packet({}));
    return packets;
}

void run(benchmark::State& state, std::string_view name, const std::vector<Packet>& packets) {
    const DecoderRow* row = find_decoder(name);
    const auto decoder = row->make(row->options.make().get());
    CountingSink sink;
    for (auto _ : state)
        for (const Packet& packet : packets) decoder->decode(packet, sink);
    if (sink.refusals != 0) state.SkipWithError("frames were refused");
    std::int64_t bytes = 0;
    for (const Packet& packet : packets) bytes += static_cast<std::int64_t>(packet.data.size());
    state.SetBytesProcessed(state.iterations() * bytes);
    state.counters["frames"] = benchmark::Counter(static_cast<double>(sink.frames), benchmark::Counter::kIsRate);
    state.counters["measurements"] =
        benchmark::Counter(static_cast<double>(sink.measurements), benchmark::Counter::kIsRate);
}

void trek1000(benchmark::State& state) {
    std::string text;
    for (int i = 0; i < 100; ++i)
        text += uwb::encode(uwb::TrekReport{'c', 15, 4, {1260 + i, 2286, 2174, 9999}, 27840, 10, 10511403});
    run(state, "trek1000", chunks({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}));
}
BENCHMARK(trek1000);

void dw1000_can(benchmark::State& state) {
    std::vector<CanFrame> frames;
    for (unsigned i = 0; i < 100; ++i)
        frames.push_back(*uwb::encode(Range{address(i % 8), address(i), 2.5 + i, 0.1f}, {}, 0, i));
    run(state, "dw1000_can", packets_of(frames));
}
BENCHMARK(dw1000_can);

void robomaster_can(benchmark::State& state) {
    std::vector<CanFrame> frames;
    for (int i = 0; i < 100; ++i)
        for (const CanFrame& frame : uwb::encode(uwb::RobomasterRecord{1, 2, 3, {251, 402, 333, 287, 1, 2}, 0}, {}))
            frames.push_back(frame);
    run(state, "robomaster_can", packets_of(frames));
}
BENCHMARK(robomaster_can);

} // namespace
