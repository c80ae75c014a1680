// No decoder allocates once it is made: the input's thread must not wait for the heap. Every row of the table is fed
// its own good frames and rubbish while allocations are counted.
#include "drivers/uwb/dw1000_can.h"
#include "drivers/uwb/robomaster_can.h"
#include "drivers/uwb/trek1000.h"
#include "tests/allocations.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>

#include <map>

namespace locus {
namespace {

struct CountingSink : MeasurementSink {
    std::size_t measurements = 0, refusals = 0;
    void accept(Timestamp, const Observation&) override { ++measurements; }
    void refuse(Refusal) override { ++refusals; }
};

CanFrame can_frame(std::uint32_t id, std::uint8_t length) { return {id, length, {1, 2, 3, 4, 5, 6, 7, 8}}; }

struct Feed {
    std::string text;
    std::vector<CanFrame> frames;
};

std::map<std::string_view, Feed> feeds() {
    const auto robomaster = encode(uwb::RobomasterRecord{1, 2, 3, {4, 5, 6, 7, 8, -9}, 0}, uwb::RobomasterSettings{});
    return {
        {"trek1000",
         {encode(uwb::TrekReport{'c', 3, 4, {1000, -5}}) + std::string(2000, 'x') + "\nmc 1\nmp\n\xff\n", {}}},
        {"dw1000_can", {"", {can_frame(0x340, 8), can_frame(0x341, 8), can_frame(0x342, 8), can_frame(0x340, 3)}}},
        {"robomaster_can", {"", {robomaster[0], robomaster[1], robomaster[2], robomaster[2]}}},
    };
}

TEST(Decoders, AllocateNothingPerFrame) {
    const auto all_feeds = feeds();
    for (const DecoderRow& row : decoder_table()) {
        ASSERT_TRUE(all_feeds.contains(row.name)) << row.name << " has no frames in this test yet";
        const Feed& feed = all_feeds.at(row.name);
        const auto decoder = row.make(row.options.make().get());
        CountingSink sink;
        const test::AllocationCount allocations;
        for (int round = 0; round < 3; ++round) {
            decoder->decode(test::bytes_packet(feed.text), sink);
            for (const CanFrame& frame : feed.frames) decoder->decode(frame.packet({}), sink);
        }
        EXPECT_EQ(allocations.made(), 0u) << row.name;
        EXPECT_GT(sink.measurements, 0u) << row.name;
        EXPECT_GT(sink.refusals, 0u) << row.name;
    }
}

} // namespace
} // namespace locus
