// Frames and bytes a second of each decoder, fed its examples as a transport would: chunks of 128 bytes, or one CAN
// frame a call.
#include "drivers/transport/stream.h"
#include "tests/examples/decoder_example.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <limits>

namespace {

using namespace locus;

struct CountingSink : MeasurementSink {
    std::int64_t measurements = 0, frames = 0, refusals = 0;
    void accept(Timestamp, const Observation& observation) override {
        benchmark::DoNotOptimize(&observation);
        ++measurements;
    }
    void frame(std::span<const std::uint8_t> /*bytes*/) override { ++frames; }
    void refuse(Refusal) override { ++refusals; }
};

constexpr std::size_t whole = std::numeric_limits<std::size_t>::max();

std::vector<Packet> pieces(std::span<const std::uint8_t> bytes, std::size_t longest = StreamTransport::max_packet) {
    std::vector<Packet> packets;
    for (; !bytes.empty(); bytes = bytes.subspan(packets.back().data.size())) {
        Packet packet;
        packet.data = bytes.first(std::min(bytes.size(), longest));
        packets.push_back(packet);
    }
    return packets;
}

void run(benchmark::State& state, const examples::DecoderExample& example) {
    examples::Chunk bytes;
    for (const auto& chunk : example.chunks) bytes.insert(bytes.end(), chunk.begin(), chunk.end());
    std::vector<Packet> packets;
    if (!example.datagrams)
        packets = pieces(bytes);
    else
        for (const auto& chunk : example.chunks) packets.push_back(pieces(chunk, whole)[0]);
    for (const CanFrame& frame : example.frames) packets.push_back(frame.packet({}));

    const auto decoder = example.make();
    CountingSink sink;
    for (auto _ : state)
        for (const Packet& packet : packets) decoder->decode(packet, sink);
    if (sink.refusals != 0) state.SkipWithError("frames were refused");
    std::int64_t size = 0;
    for (const Packet& packet : packets) size += static_cast<std::int64_t>(packet.data.size());
    state.SetBytesProcessed(state.iterations() * size);
    state.counters["frames"] = benchmark::Counter(static_cast<double>(sink.frames), benchmark::Counter::kIsRate);
    state.counters["measurements"] =
        benchmark::Counter(static_cast<double>(sink.measurements), benchmark::Counter::kIsRate);
}

} // namespace

int main(int argc, char** argv) {
    for (const auto& example : examples::all())
        benchmark::RegisterBenchmark(std::string{example.decoder}.c_str(),
                                     [&example](benchmark::State& state) { run(state, example); });
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
