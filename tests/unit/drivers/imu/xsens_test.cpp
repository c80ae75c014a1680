#include "drivers/imu/xsens.h"

#include "drivers/wire/checksum.h"
#include "tests/examples/decoder_example.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <functional>

namespace locus::imu::xsens_test {
namespace {

using test::Collector;
using xbus::Number;

/// protocols.md E-4f: recorded from an MTi (einride/xsens-go).
const auto real = examples::from_hex(
    "FA FF 36 62 10 20 02 A9 86 10 60 04 03 14 ED 53 10 10 0C 07 44 0B E0 07 E3 01 14 0D 2F 18 37 E0 20 04 01 80 00 07 "
    "40 20 0C BC 8E 54 66 C0 E8 2F 10 BF 9A D2 9E 40 10 0C B9 35 26 9F BD 94 99 30 BC 46 23 46 80 20 0C BB 42 5C 34 3B "
    "10 68 DF 3A E1 C7 E5 80 30 10 3F 80 00 01 B7 78 C7 F0 37 38 D8 27 37 10 7F EE F7");

/// A message of its own data: length and checksum are set.
examples::Chunk message(std::string_view hex, std::uint8_t kind = xbus::mtdata2) {
    const auto data = examples::from_hex(hex);
    examples::Chunk bytes{0xFA, 0xFF, kind, static_cast<std::uint8_t>(data.size())};
    bytes.insert(bytes.end(), data.begin(), data.end());
    bytes.push_back(static_cast<std::uint8_t>(-wire::sum8(wire::Bytes{bytes}.subspan(1))));
    return bytes;
}

struct Device {
    explicit Device(const XsensSettings& settings = {}) : decoder(make_xsens(&settings)) {}
    std::unique_ptr<Decoder> decoder;
    Collector sink{};

    void send(const examples::Chunk& bytes, Timestamp time = {}) {
        decoder->decode(test::bytes_packet(bytes, time), sink);
    }
};

TEST(Xsens, ReadsTheRecordedMessage) {
    const auto data = parse_mtdata2(wire::Bytes{real}.subspan(4, real.size() - 5));
    ASSERT_TRUE(data);
    EXPECT_EQ(data->packet_counter, 43398);
    EXPECT_EQ(data->sample_time_fine, 51703123u);
    EXPECT_FALSE(data->pressure_pa);

    Device device;
    device.send(real, timestamp_from_s(2));
    EXPECT_TRUE(device.sink.refusals.empty());
    const auto samples = device.sink.all<ImuSample>();
    ASSERT_EQ(samples.size(), 1u);
    const Vec3 force{-0.01737, -7.25574, -1.20955}, rate{-0.0029657, 0.0022035, 0.0017226};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(samples[0].specific_force_mps2[i], force[i], 5e-6);
        EXPECT_NEAR(samples[0].angular_rate_radps[i], rate[i], 5e-8);
    }
    EXPECT_TRUE(std::isnan(samples[0].magnetic_field_ut[0]));
    EXPECT_EQ(device.sink.items[0].time, timestamp_from_s(2));
}

TEST(Xsens, ReadsBackWhatItWritesInEveryNumberFormat) {
    EXPECT_TRUE(rc::check([](std::uint16_t counter, std::uint32_t fine, std::array<std::int32_t, 6> raw) {
        const auto number = static_cast<Number>(*rc::gen::inRange(0, 4));
        // 2^-20 is the coarsest step of the formats; 24 bits are what a float holds.
        const auto value = [&](std::size_t i) { return std::ldexp(raw[i] % (1 << 23), -20); };
        const XsensData data{counter, fine, 101'325, Vec3{value(0), value(1), value(2)},
                             Vec3{value(3), value(4), value(5)}};
        const auto bytes = encode(data, number);
        RC_ASSERT(parse_mtdata2(wire::Bytes{bytes}.subspan(4, bytes.size() - 5)) == data);
        Device device;
        device.send(bytes);
        RC_ASSERT(device.sink.frames == 1);
        RC_ASSERT(device.sink.items.size() == 2u);
    }));
}

TEST(Xsens, TheFramesOfTheEarthDoNotTurnTheSensorsAxes) {
    for (const char* frame : {"0", "4", "8"}) { // ENU, NED, NWU
        Device device;
        device.send(message(std::string{"40 2"} + frame + "0C 3F800000 00000000 00000000 80 2" + frame +
                            "0C 00000000 3F800000 00000000"));
        const auto samples = device.sink.all<ImuSample>();
        ASSERT_EQ(samples.size(), 1u);
        EXPECT_EQ(samples[0].specific_force_mps2, (Vec3{1, 0, 0}));
        EXPECT_EQ(samples[0].angular_rate_radps, (Vec3{0, 1, 0}));
    }
}

TEST(Xsens, FixedPointNumbersAreSplitAsTheDeviceSplitsThem) {
    // -0.5 as FP12.20; 1.25 and -0.75 as FP16.32: fraction, then integer.
    const auto data = parse_mtdata2(examples::from_hex("80 21 0C FFF80000 00000000 00100000"
                                                       "40 22 12 400000000001 40000000FFFF 000000000000"));
    ASSERT_TRUE(data);
    EXPECT_EQ(data->rate_radps, (Vec3{-0.5, 0, 1}));
    EXPECT_EQ(data->acceleration_mps2, (Vec3{1.25, -0.75, 0}));
}

TEST(Xsens, HighRateValuesCountWhereTheyAreAlone) {
    const std::string normal = "40 20 0C 3F800000 00000000 00000000", high = "40 40 0C 40000000 00000000 00000000";
    EXPECT_EQ(parse_mtdata2(examples::from_hex(high))->acceleration_mps2, (Vec3{2, 0, 0}));
    EXPECT_EQ(parse_mtdata2(examples::from_hex(high + normal))->acceleration_mps2, (Vec3{1, 0, 0}));
    EXPECT_EQ(parse_mtdata2(examples::from_hex(normal + high))->acceleration_mps2, (Vec3{1, 0, 0}));
}

TEST(Xsens, NoLengthInAMessageIsBelieved) {
    for (const char* wrong : {"40 20 0C 00", "40 20", "40 20 04 00000000", "40 23 0C 00000000 00000000 00000000",
                              "10 60 02 0000", "40 20 FF"}) {
        Device device;
        device.send(message(wrong));
        EXPECT_EQ(device.sink.refusals.at(0), Refusal::malformed) << wrong;
        EXPECT_EQ(device.sink.frames, 0);
    }
}

TEST(Xsens, AMessageWithoutBothHalvesIsNoSample) {
    Device device;
    device.send(message("40 20 0C 3F800000 00000000 00000000"));
    device.send(message("", 0x31)); // an answer to a command
    EXPECT_EQ(device.sink.frames, 2);
    EXPECT_TRUE(device.sink.items.empty());
    EXPECT_TRUE(device.sink.refusals.empty());
}

TEST(Xsens, WhatIsNoNumberIsRefused) {
    Device device;
    device.send(encode(XsensData{{}, {}, {}, Vec3{std::nan(""), 0, 0}, Vec3{}}));
    device.send(encode(XsensData{{}, {}, {}, Vec3{}, Vec3{0, 1e9, 0}}));
    device.send(encode(XsensData{{}, {}, 4'000'000'000u, {}, {}}));
    EXPECT_EQ(device.sink.refusals, std::vector(3, Refusal::out_of_range));
    EXPECT_TRUE(device.sink.items.empty());
}

TEST(Xsens, ReadsTheExtendedLength) {
    examples::Chunk bytes{0xFA, 0xFF, 0x36, 0xFF, 0, 0};
    for (int i = 0; i < 20; ++i)
        for (const std::uint8_t byte : examples::from_hex("40 20 0C 3F800000 00000000 00000000")) bytes.push_back(byte);
    for (const std::uint8_t byte : examples::from_hex("80 20 0C 3F800000 00000000 00000000")) bytes.push_back(byte);
    bytes[4] = static_cast<std::uint8_t>((bytes.size() - 6) >> 8);
    bytes[5] = static_cast<std::uint8_t>(bytes.size() - 6);
    bytes.push_back(static_cast<std::uint8_t>(-wire::sum8(wire::Bytes{bytes}.subspan(1))));
    Device device;
    device.send(bytes);
    EXPECT_EQ(device.sink.items.size(), 1u);
    device.send({0xFA, 0xFF, 0x36, 0xFF, 0xFF, 0xFF});
    EXPECT_EQ(device.sink.refusals.at(0), Refusal::too_long);
}

/// Received late by up to 7 ms, at 100 Hz: the device's own clock puts the samples 10 ms apart.
void expect_even_times(Device& device, const std::function<XsensData(unsigned)>& stamp) {
    for (unsigned i = 0; i < 1000; ++i) {
        XsensData data = stamp(i);
        data.acceleration_mps2 = data.rate_radps = Vec3{};
        device.send(encode(data), timestamp_from_s(1 + 0.01 * i + 0.001 * (i * 5 % 8)));
    }
    ASSERT_EQ(device.sink.items.size(), 1000u);
    for (std::size_t i = 10; i < 1000; ++i)
        ASSERT_NEAR(to_s(device.sink.items[i].time - device.sink.items[i - 1].time), 0.01, 1e-8) << i;
}

TEST(Xsens, SampleTimeFineTakesTheJitterOff) {
    Device device;
    expect_even_times(device, [](unsigned i) { return XsensData{.sample_time_fine = 0xFFFFFF00u + 100 * i}; });
}

TEST(Xsens, ThePacketCounterTakesTheJitterOffWhereItsRateIsKnown) {
    Device device{{{}, 100}};
    expect_even_times(device,
                      [](unsigned i) { return XsensData{.packet_counter = static_cast<std::uint16_t>(65000 + i)}; });
}

} // namespace
} // namespace locus::imu::xsens_test
