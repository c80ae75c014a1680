#include "drivers/uwb/robomaster_can.h"

#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace locus::uwb {
namespace {

using test::Collector;

struct Module {
    std::unique_ptr<Decoder> decoder = test::default_decoder("robomaster_can");
    Collector sink;
    std::int64_t time_ms = 0;

    void send(const CanFrame& frame, std::int64_t after_ms = 1) {
        time_ms += after_ms;
        decoder->decode(frame.packet(Timestamp{std::chrono::milliseconds{time_ms}}), sink);
    }
    void send(const std::array<CanFrame, 3>& frames) {
        for (const CanFrame& frame : frames) send(frame);
    }
};

/// protocols.md E-4b: x 3.12 m, y 4.55 m, yaw 9000, distances 2.51, 4.02, 3.33, 2.87 m.
const std::array<CanFrame, 3> bus_example{{{0x259, 8, {0x38, 0x01, 0xC7, 0x01, 0x28, 0x23, 0xFB, 0x00}},
                                           {0x259, 8, {0x92, 0x01, 0x4D, 0x01, 0x1F, 0x01, 0x00, 0x00}},
                                           {0x259, 6, {}}}};

TEST(RobomasterCan, ReadsTheExample) {
    Module module;
    module.send(bus_example);
    EXPECT_EQ(module.sink.frames, 1);
    const auto ranges = module.sink.all<Range>();
    ASSERT_EQ(ranges.size(), 4u);
    const std::array expected_m{2.51, 4.02, 3.33, 2.87};
    for (unsigned i = 0; i < 4; ++i) {
        EXPECT_EQ(ranges[i].anchor, address(i));
        EXPECT_EQ(ranges[i].tag, address(0));
        EXPECT_DOUBLE_EQ(ranges[i].range_m, expected_m[i]);
    }
    EXPECT_EQ(module.sink.items[0].time, Timestamp{std::chrono::milliseconds{1}});
}

TEST(RobomasterCan, WritesTheExample) {
    const auto frames = encode(RobomasterRecord{312, 455, 9000, {251, 402, 333, 287}, 0}, RobomasterSettings{});
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(frames[i].data, bus_example[i].data);
        EXPECT_EQ(frames[i].length, bus_example[i].length);
        EXPECT_EQ(frames[i].id, 0x259u);
    }
}

TEST(RobomasterCan, ReadsBackWhatItWrites) {
    EXPECT_TRUE(rc::check([](std::int16_t x, std::int16_t y, std::uint16_t yaw, std::array<std::int16_t, 6> distances,
                             std::uint16_t error) {
        const RobomasterRecord record{x, y, yaw, distances, error};
        const auto frames = encode(record, RobomasterSettings{});
        std::array<std::uint8_t, robomaster_record_size> bytes{};
        auto end = bytes.begin();
        for (const CanFrame& frame : frames) end = std::copy_n(frame.data.begin(), frame.length, end);
        RC_ASSERT(parse_robomaster_record(bytes) == record);
    }));
}

TEST(RobomasterCan, AWholeRecordAfterAnyLossIsDelivered) {
    for (std::size_t lost = 0; lost < 3; ++lost) {
        Module module;
        for (std::size_t i = 0; i < 3; ++i)
            if (i != lost) module.send(bus_example[i]);
        module.time_ms += 20; // the module's next record
        module.send(bus_example);
        EXPECT_EQ(module.sink.frames, 1) << lost;
        EXPECT_EQ(module.sink.all<Range>().size(), 4u) << lost;
        EXPECT_FALSE(module.sink.refusals.empty()) << lost;
    }
}

TEST(RobomasterCan, ALostEndIsSeenWithoutAGap) {
    Module module;
    module.send(bus_example[0]);
    module.send(bus_example[1]);
    module.send(bus_example);
    EXPECT_EQ(module.sink.frames, 1);
    EXPECT_EQ(module.sink.refusals, std::vector{Refusal::malformed});
}

TEST(RobomasterCan, AGapOfMoreThanTenMillisecondsBeginsARecordAnew) {
    Module module;
    module.send(bus_example[0]);
    module.send(bus_example[1], 11);
    module.send(bus_example[2]);
    EXPECT_EQ(module.sink.frames, 0);
    EXPECT_TRUE(module.sink.items.empty());
}

TEST(RobomasterCan, NegativeDistanceIsRefusedAndTheRestKept) {
    Module module;
    module.send(encode(RobomasterRecord{0, 0, 0, {-1, 5, 0, 0, 0, 0}, 0}, RobomasterSettings{}));
    EXPECT_EQ(module.sink.refusals, std::vector{Refusal::out_of_range});
    EXPECT_EQ(module.sink.all<Range>().size(), 1u);
}

TEST(RobomasterCan, OtherIdentifiersAreNotItsOwn) {
    Module module;
    module.send(CanFrame{0x258, 8, {}});
    module.send(CanFrame{0x80000259, 8, {}});
    EXPECT_TRUE(module.sink.refusals.empty());
    module.send(bus_example);
    EXPECT_EQ(module.sink.frames, 1);
}

TEST(RobomasterCan, ResetForgetsTheHalfRecord) {
    Module module;
    module.send(bus_example[0]);
    module.decoder->reset();
    module.send(bus_example);
    EXPECT_EQ(module.sink.frames, 1);
    EXPECT_TRUE(module.sink.refusals.empty());
}

} // namespace
} // namespace locus::uwb
