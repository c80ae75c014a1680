#include "drivers/imu/epson_g370.h"

#include "drivers/imu/epson_start.h"
#include "fusion/units.h"
#include "tests/examples/decoder_example.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace locus::imu::epson_test {
namespace {

// protocols.md E-4f: G370PDF1 with GPIO, count 0x1234
const auto narrow_burst = examples::from_hex("80 FE 00 05 23 00 42 FF 7C 00 21 00 00 00 00 09 C4 00 00 12 34 1E FA 0D");
const auto wide_burst = examples::from_hex("80 7E 00 05 23 5D 74 00 42 00 04 FF 7B FF F7 00 21 00 02 00 00 00 00 00 00 "
                                           "00 00 09 C4 00 00 00 00 12 34 FC 6A 0D");

EpsonSettings with_gpio(bool wide) {
    EpsonSettings settings;
    settings.wide = wide;
    settings.gpio = true;
    return settings;
}

struct Device {
    explicit Device(const EpsonSettings& settings = {}) : decoder(make_epson_g370(&settings)) {}
    std::unique_ptr<Decoder> decoder;
    test::Collector sink{};

    void send(const std::vector<std::uint8_t>& bytes, Timestamp time = {}) {
        decoder->decode(test::bytes_packet(bytes, time), sink);
    }
};

TEST(EpsonG370, ReadsTheExamples) {
    for (const bool wide : {false, true}) {
        Device device{with_gpio(wide)};
        device.send(wide ? wide_burst : narrow_burst);
        EXPECT_TRUE(device.sink.refusals.empty());
        const auto samples = device.sink.all<ImuSample>();
        ASSERT_EQ(samples.size(), 1u);
        const Vec3 rate_dps{1, -2, 0.5}, force_g{0, 0, 1};
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(samples[0].angular_rate_radps[i] / rad_per_deg, rate_dps[i], wide ? 1e-6 : 0.01);
            EXPECT_NEAR(samples[0].specific_force_mps2[i] / standard_gravity_mps2, force_g[i], 1e-9);
        }
    }
}

TEST(EpsonG370, WritesTheExamples) {
    const EpsonBurst narrow{0xFE00, 0x0523, {0x42, -0x84, 0x21}, {0, 0, 0x9C4}, 0, 0x1234};
    EXPECT_EQ(encode(narrow, with_gpio(false)), narrow_burst);
    const EpsonBurst wide{0x7E00, 0x05235D74, {0x420004, -0x840009, 0x210002}, {0, 0, 0x9C40000}, 0, 0x1234};
    EXPECT_EQ(encode(wide, with_gpio(true)), wide_burst);
}

TEST(EpsonG370, ReadsBackWhatItWritesWhateverFieldsThereAre) {
    EXPECT_TRUE(rc::check([](const std::array<bool, 7>& has, std::array<std::int16_t, 7> raw, std::uint16_t word) {
        EpsonSettings settings;
        settings.wide = has[0], settings.flag = has[1], settings.temperature = has[2];
        settings.delta_angle = has[3], settings.delta_velocity = has[4], settings.gpio = has[5],
        settings.count = has[6];
        const auto number = [&](std::size_t i) { return has[0] ? raw[i] * 40'000 : raw[i]; };
        EpsonBurst burst{0, 0, {number(0), number(1), number(2)}, {number(3), number(4), number(5)}};
        if (has[1]) burst.flag = word;
        if (has[2]) burst.temperature = number(6);
        if (has[5]) burst.gpio = word;
        if (has[6]) burst.count = word;
        const auto bytes = encode(burst, settings);
        RC_ASSERT(bytes.size() == epson_burst_length(settings));
        RC_ASSERT(bytes.size() <= longest_epson_burst);
        RC_ASSERT(parse_epson_burst(bytes, settings) == burst);
        Device device{settings};
        device.send(bytes);
        RC_ASSERT(device.sink.frames == 1);
    }));
}

TEST(EpsonG370, ModelsHaveTheirScales) {
    struct Row {
        const char* model;
        bool accel_16g;
        double rate_dps, force_mg;
    };
    for (const Row& row : {Row{"G370PDF1", false, 0.0151515, 0.4}, Row{"G370PDS0", true, 0.0066667, 0.4},
                           Row{"G370PDG0", false, 0.0151515, 0.25}, Row{"G370PDT0", true, 0.0066667, 0.5}}) {
        EpsonSettings settings;
        settings.model = row.model;
        settings.accel_16g = row.accel_16g;
        settings.wide = false;
        Device device{settings};
        device.send(encode(EpsonBurst{0, 0, {1000, 0, 0}, {1000, 0, 0}}, settings));
        const auto sample = device.sink.all<ImuSample>().at(0);
        EXPECT_NEAR(sample.angular_rate_radps[0] / rad_per_deg, 1000 * row.rate_dps, 1e-9) << row.model;
        EXPECT_NEAR(sample.specific_force_mps2[0] / standard_gravity_mps2, row.force_mg, 1e-12) << row.model;
    }
}

TEST(EpsonG370, RefusesDamageAndWhatHasOtherFields) {
    Device device{with_gpio(false)};
    auto damaged = narrow_burst;
    damaged[6] ^= 1;
    device.send(damaged);
    EXPECT_EQ(device.sink.refusals.at(0), Refusal::bad_checksum);
    Device other; // expects wide fields without GPIO
    for (int i = 0; i < 20; ++i) other.send(narrow_burst);
    EXPECT_EQ(other.sink.frames, 0);
    EXPECT_FALSE(other.sink.refusals.empty());
}

TEST(EpsonG370, TheCountTakesTheJitterOff) {
    Device device;
    for (unsigned i = 0; i < 1000; ++i)
        device.send(encode(EpsonBurst{.count = static_cast<std::uint16_t>(65000 + i)}, EpsonSettings{}),
                    timestamp_from_s(1 + 0.008 * i + 0.001 * (i * 5 % 8)));
    ASSERT_EQ(device.sink.items.size(), 1000u);
    for (std::size_t i = 10; i < 1000; ++i)
        ASSERT_NEAR(to_s(device.sink.items[i].time - device.sink.items[i - 1].time), 0.008, 1e-8) << i;
}

TEST(EpsonStart, TellsTheDeviceWhatTheSettingsSay) {
    std::vector<std::uint8_t> bytes;
    for (const EpsonCommand& command : epson_start_commands({}))
        bytes.insert(bytes.end(), command.begin(), command.end());
    // The page's start sequence, with configuration mode before it, and the filter (TAP 16) and range it leaves out.
    EXPECT_EQ(bytes, examples::from_hex("FE 00 0D 83 02 0D FE 01 0D 85 04 0D 86 04 0D 88 01 0D 8C 03 0D 8D F0 0D "
                                        "8F 70 0D 93 00 0D FE 00 0D 83 01 0D"));
}

TEST(EpsonStart, KnowsEveryRate) {
    EpsonSettings settings;
    for (const std::string_view rate : epson_rates_hz) {
        settings.rate_hz = rate;
        EXPECT_EQ(epson_start_commands(settings).size(), 12u) << rate;
    }
}

/// The commands that a device would get in a minute of steps of 10 ms; it sends a burst while `is_alive`.
template <class IsAlive>
std::vector<Timestamp> commands_in_a_minute(Device& device, const IsAlive& is_alive) {
    std::vector<Timestamp> sent;
    for (Timestamp now = timestamp_from_s(100); now < timestamp_from_s(160); now += std::chrono::milliseconds{10}) {
        if (is_alive(now)) device.send(encode(EpsonBurst{}, EpsonSettings{}), now);
        if (device.decoder->request(now)) sent.push_back(now);
    }
    return sent;
}

EpsonSettings configured() {
    EpsonSettings settings;
    settings.configure = true;
    return settings;
}

TEST(EpsonStart, StartsTheDeviceOnceWithAPauseAfterEachCommand) {
    Device device{configured()};
    const auto sent = commands_in_a_minute(device, [](Timestamp now) { return now > timestamp_from_s(101); });
    ASSERT_EQ(sent.size(), 12u);
    for (std::size_t i = 1; i < sent.size(); ++i) EXPECT_GE(sent[i] - sent[i - 1], std::chrono::milliseconds{20});
}

TEST(EpsonStart, StartsItAgainAfterASilenceAndAfterOpening) {
    Device device{configured()};
    const auto alive = [](Timestamp now) { return now < timestamp_from_s(130) || now > timestamp_from_s(134); };
    EXPECT_EQ(commands_in_a_minute(device, alive).size(), 24u);
    device.decoder->reset();
    EXPECT_TRUE(device.decoder->request(timestamp_from_s(161)));
}

TEST(EpsonStart, AsksNothingUnlessToldTo) {
    Device device;
    EXPECT_TRUE(commands_in_a_minute(device, [](Timestamp) { return false; }).empty());
}

} // namespace
} // namespace locus::imu::epson_test
