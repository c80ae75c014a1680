// Vehicles by their DBC numbers. The frames of the first test were computed by another program (protocols.md E-5).
#include "drivers/layout/can_layout.h"

#include "drivers/recording/can_text.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>

#include <cmath>

namespace locus::layout {
namespace {

CanField signal_of(const char* quantity, std::uint32_t id, int start, int length, const char* order, double factor,
                   double offset, const char* unit) {
    CanField field;
    field.quantity = quantity;
    field.can_id = id;
    field.start_bit = start;
    field.length_bits = length;
    field.byte_order = order;
    field.factor = factor;
    field.offset = offset;
    field.unit = unit;
    return field;
}

CanLayoutSettings wheels(std::uint32_t id, std::array<int, 4> starts, int length, const char* order, double factor,
                         double offset = 0) {
    CanLayoutSettings settings;
    settings.tag = address(5);
    for (const int start : starts)
        settings.fields.push_back(signal_of("wheel_speed", id, start, length, order, factor, offset, "km/h"));
    return settings;
}

struct Bus {
    explicit Bus(const CanLayoutSettings& settings) : decoder{make_can_layout(&settings)} {
        EXPECT_EQ(check_can_layout(&settings), "");
    }
    void hear(const CanFrame& frame) { decoder->decode(frame.packet({}), sink); }
    void hear(std::uint32_t id, std::initializer_list<std::uint8_t> data) {
        CanFrame frame{id, static_cast<std::uint8_t>(data.size()), {}};
        std::copy(data.begin(), data.end(), frame.data.begin());
        hear(frame);
    }
    std::unique_ptr<Decoder> decoder;
    test::Collector sink;
};

struct Car {
    CanLayoutSettings settings;
    CanFrame frame;
    double mean_kmh;
};

TEST(CanLayout, WheelSpeedsOfFourMakes) {
    const std::vector<Car> cars{
        {wheels(0x0AA, {6, 22, 38, 54}, 15, "motorola", 0.01, -67.67),
         {0x0AA, 8, {0x28, 0x7F, 0x28, 0xB1, 0x28, 0x75, 0x28, 0x89}},
         (36.0 + 36.5 + 35.9 + 36.1) / 4},
        {wheels(0x1D0, {7, 8, 25, 42}, 15, "motorola", 0.01),
         {0x1D0, 8, {0x1C, 0x20, 0x39, 0x08, 0x70, 0x30, 0xE1, 0xA0}},
         (36.0 + 36.5 + 35.9 + 36.1) / 4},
        {wheels(0x0B2, {0, 16, 32, 48}, 16, "intel", 0.0075),
         {0x0B2, 8, {0xC0, 0x12, 0x04, 0x13, 0xB3, 0x12, 0xCD, 0x12}},
         (36.0 + 36.51 + 35.9 + 36.1) / 4},
        {wheels(0x386, {0, 16, 32, 48}, 14, "intel", 0.03125),
         {0x386, 8, {0x80, 0x04, 0x90, 0x04, 0x7C, 0x04, 0x84, 0x04}},
         (36.0 + 36.5 + 35.875 + 36.125) / 4},
    };
    for (const Car& car : cars) {
        Bus bus{car.settings};
        bus.hear(car.frame);
        const auto speeds = bus.sink.all<WheelSpeed>();
        ASSERT_EQ(speeds.size(), 1u) << std::hex << car.frame.id;
        EXPECT_NEAR(speeds[0].speed_mps * 3.6, car.mean_kmh, 0.005) << std::hex << car.frame.id;
        EXPECT_EQ(speeds[0].tag, address(5));
        EXPECT_TRUE(std::isnan(speeds[0].yaw_rate_radps));
    }
}

TEST(CanLayout, WhatIsEncodedIsDecoded) {
    const auto settings = wheels(0x0AA, {6, 22, 38, 54}, 15, "motorola", 0.01, -67.67);
    const CanFrame frame = encode(settings, 0x0AA, std::array{36.0, 36.5, 35.9, 36.1});
    EXPECT_EQ(frame.data, (std::array<std::uint8_t, 8>{0x28, 0x7F, 0x28, 0xB1, 0x28, 0x75, 0x28, 0x89}));
}

/// Bosch's sensor of protocols.md 5.3: yaw rate in a frame of its own.
TEST(CanLayout, AYawRateIsPutBesideTheNextSpeed) {
    auto settings = wheels(0x343, {0, 16, 32, 48}, 16, "intel", 0.015625 * 3.6);
    settings.fields.push_back(signal_of("yaw_rate", 0x070, 0, 16, "intel", 0.005, -163.84, "deg/s"));
    Bus bus{settings};
    bus.hear(0x070, {0x00, 0x88}); // (34816 - 32768) * 0.005 = 10.24 deg/s
    EXPECT_TRUE(bus.sink.items.empty());
    bus.hear(0x343, {0x40, 0, 0x40, 0, 0x40, 0, 0x40, 0});
    bus.hear(0x343, {0x40, 0, 0x40, 0, 0x40, 0, 0x40, 0});
    const auto speeds = bus.sink.all<WheelSpeed>();
    ASSERT_EQ(speeds.size(), 2u);
    EXPECT_NEAR(speeds[0].speed_mps, 1.0, 1e-12);
    EXPECT_NEAR(speeds[0].yaw_rate_radps, 0.178722, 1e-6);
    EXPECT_TRUE(std::isnan(speeds[1].yaw_rate_radps)) << "an old rate is not told twice";
}

TEST(CanLayout, WheelsInTwoFramesWaitForEachOther) {
    CanLayoutSettings settings;
    settings.fields = {signal_of("wheel_speed", 0x10, 0, 16, "intel", 1, 0, "m/s"),
                       signal_of("wheel_speed", 0x11, 0, 16, "intel", 1, 0, "m/s")};
    Bus bus{settings};
    bus.hear(0x10, {3, 0});
    bus.hear(0x10, {4, 0});
    EXPECT_TRUE(bus.sink.items.empty());
    bus.hear(0x11, {6, 0});
    ASSERT_EQ(bus.sink.all<WheelSpeed>().size(), 1u);
    EXPECT_EQ(bus.sink.all<WheelSpeed>()[0].speed_mps, 5);
}

TEST(CanLayout, AMultiplexorSaysWhichFieldsAreThere) {
    CanLayoutSettings settings;
    settings.fields = {signal_of("multiplexor", 0x20, 0, 8, "intel", 1, 0, "none"),
                       signal_of("pressure", 0x20, 8, 16, "intel", 10, 0, "Pa"),
                       signal_of("wheel_speed", 0x20, 8, 16, "intel", 1, 0, "mm/s")};
    settings.fields[1].multiplexed_by = 3;
    settings.fields[2].multiplexed_by = 4;
    Bus bus{settings};
    bus.hear(0x20, {3, 0x94, 0x27});
    bus.hear(0x20, {4, 0xE8, 0x03});
    bus.hear(0x20, {5, 0xFF, 0xFF});
    ASSERT_EQ(bus.sink.items.size(), 2u);
    EXPECT_EQ(std::get<Pressure>(bus.sink.items[0].observation).pressure_pa, 101'320);
    EXPECT_EQ(std::get<WheelSpeed>(bus.sink.items[1].observation).speed_mps, 1);
}

TEST(CanLayout, RangesCarryWhoMeasuredThem) {
    CanLayoutSettings settings;
    settings.anchor_offset = 100;
    settings.fields = {signal_of("range", 0x18FF1200, 0, 16, "intel", 1, 0, "cm"),
                       signal_of("anchor", 0x18FF1200, 16, 8, "intel", 1, 0, "none"),
                       signal_of("tag", 0x18FF1200, 24, 8, "intel", 1, 0, "none")};
    for (CanField& field : settings.fields) field.can_id_ignored = 0xFF;
    settings.fields[0].invalid_raw = 0xFFFF;
    Bus bus{settings};
    constexpr std::uint32_t extended = 0x80000000;
    bus.hear(0x18FF1233 | extended, {0xF4, 0x01, 3, 9});
    bus.hear(0x18FF1233 | extended, {0xFF, 0xFF, 4, 9});
    bus.hear(0x18FF1333 | extended, {0xF4, 0x01, 3, 9});
    bus.hear(0x212, {0xF4, 0x01, 3, 9});
    const auto ranges = bus.sink.all<Range>();
    ASSERT_EQ(ranges.size(), 1u);
    EXPECT_EQ(ranges[0].range_m, 5);
    EXPECT_EQ(ranges[0].anchor, address(103));
    EXPECT_EQ(ranges[0].tag, address(9));
    EXPECT_TRUE(bus.sink.refusals.empty());
}

TEST(CanLayout, ShortFramesAndImpossibleValuesAreRefused) {
    auto settings = wheels(0x343, {0, 16, 32, 48}, 16, "intel", 1);
    Bus bus{settings};
    bus.hear(0x343, {1, 2, 3});
    bus.hear(0x343, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF});
    EXPECT_EQ(bus.sink.refusals, (std::vector{Refusal::malformed, Refusal::out_of_range}));
    EXPECT_TRUE(bus.sink.items.empty());
}

TEST(CanLayout, SaysWhatDoesNotFitTogether) {
    CanLayoutSettings settings;
    EXPECT_EQ(check_can_layout(&settings), "fields is empty: without it no frame means anything");
    settings.fields = {signal_of("yaw_rate", 1, 0, 16, "intel", 1, 0, "km/h")};
    EXPECT_EQ(check_can_layout(&settings),
              "item 1 of fields (yaw_rate): yaw_rate cannot have the unit km/h; it can have rad/s, deg/s");
    settings.fields[0].unit = "deg/s";
    settings.fields[0].type = "float";
    EXPECT_EQ(check_can_layout(&settings), "item 1 of fields (yaw_rate): a float has 32 bits");
}

} // namespace
} // namespace locus::layout
