#include "drivers/imu/vectornav.h"

#include "drivers/wire/checksum.h"
#include "tests/examples/decoder_example.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace locus::imu::vectornav_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

// protocols.md E-4f: the first from the maker's manual (yaw, pitch, roll), the second computed.
const Bytes attitude = examples::from_hex("FA 01 08 00 93 50 2E 42 83 3E F1 3F 48 B5 04 BB 92 88");
constexpr std::string_view line =
    "$VNYMR,+073.632,-006.410,+000.278,+01.0670,-00.2568,+03.0696,-00.754,+01.222,-09.778,+00.000480,+00.000130,"
    "-00.000210*6F";

struct Device {
    VectorNavSettings settings{};
    std::unique_ptr<Decoder> decoder = make_vectornav(&settings);
    test::Collector sink{};

    void send(const Bytes& bytes, Timestamp time = {}) { decoder->decode(test::bytes_packet(bytes, time), sink); }
    void send(std::string_view text) { decoder->decode(test::bytes_packet(text), sink); }
};

/// With masks and payload as they are, and the right checksum.
Bytes message(std::string_view hex) {
    Bytes bytes = examples::from_hex(hex);
    const std::uint16_t crc = wire::crc16_xmodem(wire::Bytes{bytes}.subspan(1));
    bytes.push_back(static_cast<std::uint8_t>(crc >> 8));
    bytes.push_back(static_cast<std::uint8_t>(crc));
    return bytes;
}

TEST(VectorNav, KnowsTheManualsMessageForWhole) {
    EXPECT_EQ(vectornav_length(attitude), attitude.size());
    Device device;
    device.send(attitude);
    EXPECT_EQ(device.sink.frames, 1);
    EXPECT_TRUE(device.sink.refusals.empty());
    EXPECT_TRUE(device.sink.items.empty()); // angles are no sample
}

TEST(VectorNav, ReadsTheLine) {
    Device device;
    device.send(std::string{line} + "\r\n");
    EXPECT_TRUE(device.sink.refusals.empty());
    const auto samples = device.sink.all<ImuSample>();
    ASSERT_EQ(samples.size(), 1u);
    EXPECT_EQ(samples[0].specific_force_mps2, (Vec3{-0.754, 1.222, -9.778}));
    EXPECT_EQ(samples[0].angular_rate_radps, (Vec3{0.00048, 0.00013, -0.00021}));
    EXPECT_NEAR(samples[0].magnetic_field_ut[0], 106.7, 1e-3);
    EXPECT_NEAR(samples[0].magnetic_field_ut[1], -25.68, 1e-3);
    EXPECT_NEAR(samples[0].magnetic_field_ut[2], 306.96, 1e-3);
}

TEST(VectorNav, WritesTheLineAsTheDeviceDoes) {
    const std::string written = encode_vnymr(*parse_vnymr(line)); // we have no angles
    const auto values = [](std::string_view text) {
        const std::size_t first = text.find(",+01");
        return text.substr(first, text.find('*') - first);
    };
    EXPECT_EQ(values(written), values(line));
    EXPECT_EQ(written.size(), line.size() + 2);
    EXPECT_EQ(parse_vnymr(std::string_view{written}.substr(0, written.size() - 2)), parse_vnymr(line));
}

TEST(VectorNav, RefusesDamagedLines) {
    std::string damaged{line};
    damaged[20] = '9';
    for (const std::string& text :
         {damaged, std::string{"$VNYMR,1,2*50"}, std::string{"$VNYMR,*"}, std::string{"$VNYMR"}})
        EXPECT_FALSE(parse_vnymr(text)) << text;
    Device device;
    device.send(damaged + "\r\n" + "$VNYMR," + std::string(200, '1') + "\r\n" + std::string{line} + "\r\n");
    EXPECT_EQ(device.sink.items.size(), 1u);
    EXPECT_EQ(device.sink.refusals.at(0), Refusal::bad_checksum);
}

TEST(VectorNav, ReadsBackWhatItWrites) {
    EXPECT_TRUE(rc::check([](std::array<std::int16_t, 9> raw, std::uint64_t time, std::array<bool, 4> has) {
        const auto vector = [&](std::size_t i) { return Vec3{raw[i] / 256.0, raw[i + 1] / 256.0, raw[i + 2] / 256.0}; };
        VectorNavData data;
        if (has[0]) data.time_startup_ns = time;
        if (has[1]) data.rate_radps = vector(0);
        if (has[2]) data.acceleration_mps2 = vector(3);
        if (has[3]) data.magnetic_gauss = vector(6), data.pressure_kpa = 101.5;
        const Bytes bytes = encode(data);
        RC_ASSERT(vectornav_length(bytes) == bytes.size());
        RC_ASSERT(parse_vectornav(bytes) == data);
        Device device;
        device.send(bytes);
        RC_ASSERT(device.sink.frames == 1);
    }));
}

TEST(VectorNav, FindsItsFieldsAmongOthers) {
    // Common: TimeStartup, TimeGps, YawPitchRoll, AngularRate, Position, Accel, SyncInCnt; Time: TimeGps; GPS:
    // satellites.
    const Bytes bytes = message("FA 0B 6B21 0200 0400"
                                "0100000000000000 AAAAAAAAAAAAAAAA 000000000000000000000000"
                                "0000803F 00000040 00004040"
                                "000000000000000000000000000000000000000000000000"
                                "00000000 00000000 00001C41"
                                "01000000"
                                "BBBBBBBBBBBBBBBB CCCC");
    ASSERT_EQ(vectornav_length(bytes), bytes.size());
    Device device;
    device.send(bytes);
    const auto samples = device.sink.all<ImuSample>();
    ASSERT_EQ(samples.size(), 1u);
    EXPECT_EQ(samples[0].angular_rate_radps, (Vec3{1, 2, 3}));
    EXPECT_EQ(samples[0].specific_force_mps2, (Vec3{0, 0, 9.75}));
    EXPECT_TRUE(std::isnan(samples[0].magnetic_field_ut[0]));
}

TEST(VectorNav, UncorrectedValuesCountWhereTheyAreAlone) {
    const std::string uncorrected = "0000803F 00000000 00000000 00000000 00000040 00000000"; // force, then rate
    Device device;
    device.send(message("FA 01 0002" + uncorrected));
    device.send(message("FA 01 2003 00000000 00000000 00000000 00000000 00000000 00000000" + uncorrected));
    const auto samples = device.sink.all<ImuSample>();
    ASSERT_EQ(samples.size(), 2u);
    EXPECT_EQ(samples[0].specific_force_mps2, (Vec3{1, 0, 0}));
    EXPECT_EQ(samples[0].angular_rate_radps, (Vec3{0, 2, 0}));
    EXPECT_EQ(samples[1].specific_force_mps2, (Vec3{}));
    EXPECT_EQ(samples[1].angular_rate_radps, (Vec3{}));
}

TEST(VectorNav, MagneticFieldAndPressureAreInPhysicalUnits) {
    Device device;
    device.send(encode(VectorNavData{{}, Vec3{}, Vec3{}, Vec3{0.25, 0, -0.5}, 101.325}));
    ASSERT_EQ(device.sink.items.size(), 2u);
    const auto& sample = std::get<ImuSample>(device.sink.items[0].observation);
    EXPECT_EQ(sample.magnetic_field_ut, (Vec3f{25, 0, -50}));
    EXPECT_NEAR(std::get<Pressure>(device.sink.items[1].observation).pressure_pa, 101'325, 0.01);
}

TEST(VectorNav, GroupsAndFieldsThatDoNotExistAreRefused) {
    for (const char* wrong : {"FA 00 0000", "FA 80 0000", "FA 01 0080", "FA 02 0004", "FA 40 0040"}) {
        EXPECT_EQ(vectornav_length(examples::from_hex(wrong)), 0u) << wrong;
        Device device;
        device.send(message(wrong));
        EXPECT_EQ(device.sink.frames, 0) << wrong;
        EXPECT_FALSE(device.sink.refusals.empty()) << wrong;
    }
}

TEST(VectorNav, TheLongestMessageFits) {
    Bytes all = examples::from_hex("FA 7F FF7F FF03 FF1F FF3F FF1F FF1F FF3F");
    ASSERT_TRUE(vectornav_length(all));
    ASSERT_LE(*vectornav_length(all), longest_vectornav_message);
    std::string hex = "FA 7F FF7F FF03 FF1F FF3F FF1F FF1F FF3F";
    hex += std::string(2 * (*vectornav_length(all) - all.size() - 2), '0');
    Device device;
    device.send(message(hex));
    EXPECT_EQ(device.sink.all<ImuSample>().size(), 1u);
}

TEST(VectorNav, TimeSinceStartupTakesTheJitterOff) {
    Device device;
    for (unsigned i = 0; i < 1000; ++i)
        device.send(encode(VectorNavData{12'345'000'000'000 + 10'000'000ull * i, Vec3{}, Vec3{}, {}, {}}),
                    timestamp_from_s(1 + 0.01 * i + 0.001 * (i * 5 % 8)));
    ASSERT_EQ(device.sink.items.size(), 1000u);
    for (std::size_t i = 10; i < 1000; ++i)
        ASSERT_NEAR(to_s(device.sink.items[i].time - device.sink.items[i - 1].time), 0.01, 1e-8) << i;
}

TEST(VectorNav, WhatIsNoNumberIsRefused) {
    Device device;
    device.send(encode(VectorNavData{{}, Vec3{std::nan(""), 0, 0}, Vec3{}, {}, {}}));
    device.send(encode(VectorNavData{{}, Vec3{}, Vec3{}, Vec3{std::nan(""), 0, 0}, std::nan("")}));
    EXPECT_EQ(device.sink.refusals, std::vector(2, Refusal::out_of_range)); // a rate, a pressure
    ASSERT_EQ(device.sink.items.size(), 1u);
    EXPECT_TRUE(std::isnan(device.sink.all<ImuSample>()[0].magnetic_field_ut[0]));
}

} // namespace
} // namespace locus::imu::vectornav_test
