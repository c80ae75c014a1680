#include "drivers/imu/xsens_can.h"

#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace locus::imu::xsens_can_test {
namespace {

struct Device {
    explicit Device(const XsensCanSettings& settings = {}) : decoder(make_xsens_can(&settings)) {}
    std::unique_ptr<Decoder> decoder;
    test::Collector sink{};

    void send(const CanFrame& frame, Timestamp time = {}) { decoder->decode(frame.packet(time), sink); }
    void send(const std::vector<CanFrame>& frames, Timestamp time = {}) {
        for (const CanFrame& frame : frames) send(frame, time);
    }
};

// protocols.md E-4f
const CanFrame sample_time{0x05, 4, {0x03, 0x14, 0xED, 0x53}};
const CanFrame rate{0x32, 6, {0x00, 0x33, 0xFF, 0x9A, 0x03, 0x00}};
const CanFrame acceleration{0x34, 6, {0x00, 0x00, 0x00, 0x00, 0x09, 0xCF}};

TEST(XsensCan, ReadsTheExamples) {
    Device device;
    device.send({sample_time, rate, acceleration}, timestamp_from_s(3));
    EXPECT_TRUE(device.sink.refusals.empty());
    const auto samples = device.sink.all<ImuSample>();
    ASSERT_EQ(samples.size(), 1u);
    const Vec3 rate_radps{0.0996, -0.1992, 1.5}, force_mps2{0, 0, 9.809};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(samples[0].angular_rate_radps[i], rate_radps[i], 5e-5);
        EXPECT_NEAR(samples[0].specific_force_mps2[i], force_mps2[i], 1e-3);
    }
    EXPECT_EQ(device.sink.items[0].time, timestamp_from_s(3));
}

TEST(XsensCan, WritesTheExamples) {
    const auto frames = encode(XsensCanSample{51703123, 1, {0.0996, -0.1992, 1.5}, {0, 0, 9.809}});
    ASSERT_EQ(frames.size(), 4u);
    const std::array wanted{sample_time, CanFrame{0x06, 2, {0, 1}}, rate, acceleration};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(frames[i].id, wanted[i].id);
        EXPECT_EQ(frames[i].length, wanted[i].length);
        EXPECT_EQ(frames[i].data, wanted[i].data);
    }
}

TEST(XsensCan, ReadsBackWhatItWrites) {
    EXPECT_TRUE(rc::check([](std::array<std::int16_t, 6> raw, std::uint32_t time, std::uint16_t counter, bool timed) {
        const XsensCanSample sample{timed ? std::optional{time} : std::nullopt,
                                    counter,
                                    {raw[0] / 512.0, raw[1] / 512.0, raw[2] / 512.0},
                                    {raw[3] / 256.0, raw[4] / 256.0, raw[5] / 256.0},
                                    101'325};
        Device device;
        device.send(encode(sample));
        RC_ASSERT(device.sink.refusals.empty());
        const auto& imu = std::get<ImuSample>(device.sink.items.at(0).observation);
        RC_ASSERT(imu.angular_rate_radps == sample.rate_radps);
        RC_ASSERT(imu.specific_force_mps2 == sample.acceleration_mps2);
        RC_ASSERT(std::get<Pressure>(device.sink.items.at(1).observation).pressure_pa == 101'325);
    }));
}

TEST(XsensCan, OneLostFrameCostsNoOtherSample) {
    const auto sample = [](std::uint16_t i) {
        return encode(XsensCanSample{100u * i, i, {0.5, 0, 0}, {0, 0, 1.0 * i}});
    };
    for (std::size_t lost = 0; lost < 4; ++lost) {
        Device device;
        device.send(sample(1));
        auto damaged = sample(2);
        damaged.erase(damaged.begin() + static_cast<std::ptrdiff_t>(lost));
        device.send(damaged);
        device.send(sample(3));
        const auto samples = device.sink.all<ImuSample>();
        EXPECT_EQ(samples.size(), lost < 2 ? 3u : 2u) << lost; // time or counter: the other one begins the group
        EXPECT_EQ(device.sink.refusals.size(), lost < 2 ? 0u : 1u) << lost;
        EXPECT_EQ(samples.back().specific_force_mps2[2], 3);
    }
}

TEST(XsensCan, HalvesOfTwoGroupsMakeNoSample) {
    Device device;
    device.send({sample_time, rate});
    device.send({rate, acceleration}); // without a beginning
    EXPECT_TRUE(device.sink.items.empty());
    device.send({sample_time, acceleration, sample_time, rate});
    EXPECT_TRUE(device.sink.items.empty());
    EXPECT_EQ(device.sink.refusals, std::vector(4, Refusal::malformed));
}

TEST(XsensCan, TheSampleTimeTakesTheJitterOff) {
    for (const double tick_us : {100.0, 1.0}) {
        Device device{{{}, tick_us}};
        for (std::uint32_t i = 0; i < 1000; ++i)
            device.send(encode(XsensCanSample{0xFFFFFF00u + i * static_cast<std::uint32_t>(10'000 / tick_us)}),
                        timestamp_from_s(1 + 0.01 * i + 0.001 * (i * 5 % 8)));
        ASSERT_EQ(device.sink.items.size(), 1000u);
        for (std::size_t i = 10; i < 1000; ++i)
            ASSERT_NEAR(to_s(device.sink.items[i].time - device.sink.items[i - 1].time), 0.01, 1e-8) << i;
    }
}

/// The public sources do not agree on it.
TEST(XsensCan, AWrongTickLeavesTheTimesOfReception) {
    Device device; // takes ticks of 100 us
    for (std::uint32_t i = 0; i < 1000; ++i)
        device.send(encode(XsensCanSample{i * 10'000}), timestamp_from_s(1 + 0.01 * i));
    for (std::size_t i = 0; i < 1000; ++i)
        ASSERT_EQ(device.sink.items[i].time, timestamp_from_s(1 + 0.01 * static_cast<double>(i))) << i;
}

TEST(XsensCan, RefusesWrongLengthsAndKnowsOthersFrames) {
    Device device;
    device.send({{0x05, 3, {}}, {0x32, 8, {}}});
    EXPECT_EQ(device.sink.refusals, std::vector(2, Refusal::malformed));
    device.send({{0x21, 8, {}}, {0x80000032, 6, {}}, {0x300, 1, {}}});
    EXPECT_EQ(device.sink.refusals.size(), 2u);
    device.send({0x52, 4, {}});
    EXPECT_EQ(device.sink.refusals.back(), Refusal::out_of_range);
}

} // namespace
} // namespace locus::imu::xsens_can_test
