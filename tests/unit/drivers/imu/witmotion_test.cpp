#include "drivers/imu/witmotion.h"

#include "fusion/units.h"
#include "tests/examples/decoder_example.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace locus::imu::witmotion_test {
namespace {

using examples::from_hex;
using test::Collector;

// protocols.md E-4f
constexpr auto acceleration_hex = "55 51 00 00 00 00 00 08 C4 09 7B";
constexpr auto rate_hex = "55 52 A4 00 00 00 AE FF 00 00 F8";
constexpr auto angle_hex = "55 53 55 15 E4 F8 00 40 00 00 2E";
constexpr auto quaternion_hex = "55 59 FF 7F 00 00 00 00 00 00 2C";

struct Module {
    std::unique_ptr<Decoder> decoder = make_witmotion(WitMotionSettings{{.tag = address(4)}});
    Collector sink;

    static std::unique_ptr<Decoder> make_witmotion(const WitMotionSettings& s) { return imu::make_witmotion(&s); }
    void send(std::string_view hex, Timestamp time = {}, Duration byte_time = {}) {
        const auto bytes = from_hex(hex);
        decoder->decode(test::bytes_packet(bytes, time, byte_time), sink);
    }
    void send(const WitFrame& frame) { decoder->decode(test::bytes_packet(encode(frame)), sink); }
};

TEST(WitMotion, ReadsTheExamples) {
    Module module;
    for (const auto hex : {acceleration_hex, rate_hex, angle_hex, quaternion_hex}) module.send(hex);
    EXPECT_EQ(module.sink.frames, 4);
    EXPECT_TRUE(module.sink.refusals.empty());
    const auto samples = module.sink.all<ImuSample>();
    ASSERT_EQ(samples.size(), 1u);
    EXPECT_EQ(samples[0].tag, address(4));
    EXPECT_EQ(samples[0].specific_force_mps2, (Vec3{0, 0, 9.80665}));
    EXPECT_NEAR(samples[0].angular_rate_radps[0] / rad_per_deg, 10.01, 5e-3);
    EXPECT_EQ(samples[0].angular_rate_radps[1], 0);
    EXPECT_NEAR(samples[0].angular_rate_radps[2] / rad_per_deg, -5.00, 6e-3);
    EXPECT_TRUE(std::isnan(samples[0].magnetic_field_ut[0]));
}

TEST(WitMotion, WritesTheExamples) {
    const auto hex = [](const WitFrame& frame) {
        const auto bytes = encode(frame);
        return examples::Chunk(bytes.begin(), bytes.end());
    };
    WitFrame acceleration = wit_acceleration({0, 0, standard_gravity_mps2});
    acceleration.words[3] = 2500; // temperature
    EXPECT_EQ(hex(acceleration), from_hex(acceleration_hex));
    EXPECT_EQ(hex(wit_rate({10.01 * rad_per_deg, 0, -5 * rad_per_deg})), from_hex(rate_hex));
    EXPECT_EQ(hex({WitFrame::angle, {0x1555, -0x71C, 0x4000, 0}}), from_hex(angle_hex));
}

TEST(WitMotion, ReadsBackWhatItWrites) {
    EXPECT_TRUE(rc::check([](std::array<std::int16_t, 4> words) {
        const WitFrame frame{*rc::gen::inRange<std::uint8_t>(0x50, 0x60), words};
        RC_ASSERT(parse_wit_frame(encode(frame)) == frame);
    }));
}

TEST(WitMotion, SamplesKeepTheStepsOfTheFormat) {
    EXPECT_TRUE(rc::check([](std::array<std::int16_t, 3> force, std::array<std::int16_t, 3> rate) {
        Module module;
        const Vec3 force_mps2{force[0] / 210.0, force[1] / 210.0, force[2] / 210.0};
        const Vec3 rate_radps{rate[0] / 950.0, rate[1] / 950.0, rate[2] / 950.0};
        module.send(wit_acceleration(force_mps2));
        module.send(wit_rate(rate_radps));
        const auto sample = module.sink.all<ImuSample>().at(0);
        for (std::size_t i = 0; i < 3; ++i) {
            RC_ASSERT(std::abs(sample.specific_force_mps2[i] - force_mps2[i]) < 2.5e-3);
            RC_ASSERT(std::abs(sample.angular_rate_radps[i] - rate_radps[i]) < 6e-4);
        }
    }));
}

TEST(WitMotion, PressureIsInPascal) {
    Module module;
    module.send(wit_pressure(101'325));
    EXPECT_EQ(module.sink.all<Pressure>().at(0).pressure_pa, 101'325);
    EXPECT_EQ(module.sink.all<Pressure>().at(0).tag, address(4));
    module.send(wit_pressure(-1));
    EXPECT_EQ(module.sink.refusals, std::vector{Refusal::out_of_range});
}

TEST(WitMotion, TheSampleIsOfTheBeginningOfItsAcceleration) {
    Module module; // at 9600 baud, both frames in one chunk
    const auto byte_time = Duration{1'041'667};
    module.send(std::string{acceleration_hex} + rate_hex, timestamp_from_s(1), byte_time);
    EXPECT_EQ(module.sink.items.at(0).time, timestamp_from_s(1) - 22 * byte_time);
}

TEST(WitMotion, HalvesOfTwoCyclesMakeNoSample) {
    const auto acceleration = wit_acceleration({0, 0, 9.8}), rate = wit_rate({1, 0, 0});
    const WitFrame angle{WitFrame::angle, {}};
    for (const auto& frames : {std::vector{rate, angle}, {acceleration, angle, rate}, {acceleration, angle}}) {
        Module module;
        for (const WitFrame& frame : frames) module.send(frame);
        EXPECT_TRUE(module.sink.items.empty());
        EXPECT_FALSE(module.sink.refusals.empty());
    }
}

TEST(WitMotion, DamageBetweenTheHalvesPartsThem) {
    Module module;
    module.send(acceleration_hex);
    module.send("55 52 A4 00 00 00 AE FF 00 00 F9"); // its rate, damaged
    module.send("55 51 00 00 00 00 00 08 C4 09 7C"); // the next cycle's acceleration, damaged
    module.send(rate_hex);
    EXPECT_TRUE(module.sink.items.empty());
}

struct CanModule {
    std::unique_ptr<Decoder> decoder = test::default_decoder("witmotion_can");
    Collector sink;
    void send(const CanFrame& frame, Timestamp time = {}) { decoder->decode(frame.packet(time), sink); }
};

TEST(WitMotionCan, ReadsTheExample) {
    CanModule module;
    module.send({0x50, 8, {0x55, 0x51, 0, 0, 0, 0, 0, 8}}, timestamp_from_ns(7));
    module.send(encode_can(wit_rate({1, 0, -2}), 0x50), timestamp_from_ns(8));
    const auto samples = module.sink.all<ImuSample>();
    ASSERT_EQ(samples.size(), 1u);
    EXPECT_EQ(samples[0].specific_force_mps2, (Vec3{0, 0, 9.80665}));
    EXPECT_NEAR(samples[0].angular_rate_radps[2], -2, 1e-3);
    EXPECT_EQ(module.sink.items[0].time, timestamp_from_ns(7));
}

TEST(WitMotionCan, WritesTheExample) {
    const CanFrame frame = encode_can(wit_acceleration({0, 0, standard_gravity_mps2}), 0x50);
    EXPECT_EQ(frame.data, (std::array<std::uint8_t, 8>{0x55, 0x51, 0, 0, 0, 0, 0, 8}));
}

TEST(WitMotionCan, RefusesWhatIsNoFrameOfIts) {
    CanModule module;
    const CanFrame acceleration = encode_can(wit_acceleration({}), 0x50);
    module.send(acceleration);
    module.send({0x50, 7, {0x55, 0x52}});
    module.send({0x50, 8, {0x54, 0x52}});
    module.send({0x50, 8, {0x55, 0x70}});
    module.send(encode_can(wit_rate({}), 0x50)); // its acceleration is no longer believed
    EXPECT_EQ(module.sink.refusals,
              (std::vector{Refusal::malformed, Refusal::malformed, Refusal::unknown_type, Refusal::malformed}));
    module.send({0x51, 8, {}});
    module.send({0x80000050, 8, {}}); // extended identifier
    EXPECT_EQ(module.sink.refusals.size(), 4u);
    EXPECT_TRUE(module.sink.items.empty());
}

} // namespace
} // namespace locus::imu::witmotion_test
