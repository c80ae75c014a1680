// No decoder allocates once it is made: the input's thread must not wait for the heap. Every row of the table is fed
// its own good frames and rubbish while allocations are counted.
#include "tests/allocations.h"
#include "tests/examples/decoder_example.h"
#include "tests/support/source_folder.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace locus {
namespace {

struct CountingSink : MeasurementSink {
    std::size_t measurements = 0, refusals = 0;
    void accept(Timestamp, const Observation&) override { ++measurements; }
    void refuse(Refusal) override { ++refusals; }
};

const std::string rubbish = std::string(2000, 'x') + "\nmc 1\n$GPGGA,1*00\n\xff\n" + std::string(2000, '\xf7') + "\n";

TEST(Decoders, AllocateNothingPerFrame) {
    for (const auto& example : examples::all()) {
        const auto decoder = example.make();
        CountingSink sink;
        const test::AllocationCount allocations;
        for (int round = 0; round < 3; ++round) {
            for (const auto& chunk : example.chunks) decoder->decode(test::bytes_packet(chunk), sink);
            for (const CanFrame& frame : example.frames) decoder->decode(frame.packet({}), sink);
            for (const CanFrame& frame : example.rubbish) decoder->decode(frame.packet({}), sink);
            if (!example.chunks.empty()) decoder->decode(test::bytes_packet(rubbish), sink);
        }
        EXPECT_EQ(allocations.made(), 0u) << example.decoder;
        EXPECT_GT(sink.measurements, 0u) << example.decoder;
        EXPECT_GT(sink.refusals, 0u) << example.decoder;
    }
}

TEST(Decoders, EachHasExamplesAndACorpus) {
    for (const DecoderRow& row : decoder_table()) {
        EXPECT_TRUE(std::ranges::any_of(examples::all(), [&](const auto& e) { return e.decoder == row.name; }))
            << row.name << ": add a file to tests/examples";
        EXPECT_TRUE(
            std::filesystem::is_directory(test::source_folder() + "/tests/fuzz/corpus/" + std::string{row.name}))
            << row.name << ": add it to tests/fuzz/CMakeLists.txt, with a corpus";
    }
}

} // namespace
} // namespace locus
