// A device with a crystal of its own behind transports that delay its packets: how well the clock finds the times
// again.
#include "drivers/device_clock.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace locus::device_clock_test {
namespace {

using Random = std::mt19937_64;

struct Packet {
    double taken_s;    ///< host time, true
    double received_s; ///< host time
    std::uint64_t count;
};

struct Device {
    double rate_hz = 200;
    double drift = 50e-6;  ///< the host's second is longer than the device's by it
    double start_s = 1000; ///< host time of the first sample
    double lost = 0;       ///< share of the packets
    unsigned bits = 16;
};

/// Each packet is delayed, and none overtakes another.
template <class Delay>
std::vector<Packet> simulate(const Device& device, double duration_s, std::uint64_t seed, Delay delay) {
    Random random{seed};
    std::vector<Packet> packets;
    double last_s = 0;
    for (std::uint64_t i = 0; static_cast<double>(i) < duration_s * device.rate_hz; ++i) {
        const double taken_s = device.start_s + static_cast<double>(i) / device.rate_hz * (1 + device.drift);
        last_s = std::max(last_s, delay(taken_s, random));
        if (std::bernoulli_distribution{device.lost}(random)) continue;
        packets.push_back({taken_s, last_s, (i + 65000) & ((std::uint64_t{1} << device.bits) - 1)});
    }
    return packets;
}

double exponential_5_ms(double taken_s, Random& random) {
    return taken_s + std::exponential_distribution{1 / 0.005}(random);
}
/// Polled at the frames of USB, and the controller's own few microseconds.
double frames_1_ms(double taken_s, Random& random) {
    return std::ceil(taken_s * 1e3) / 1e3 + std::uniform_real_distribution{0.0, 20e-6}(random);
}
/// The latency timer of USB serial converters: everything of 16 ms at once.
double bursts_16_ms(double taken_s, Random& random) {
    return std::ceil(taken_s / 0.016) * 0.016 + std::uniform_real_distribution{0.0, 100e-6}(random);
}

double rms(const std::vector<double>& values) {
    return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0) /
                     static_cast<double>(values.size()));
}

struct Errors {
    double received_dt_s, mapped_dt_s; ///< RMS of the error of the time between packets
    double late_s, early_s;            ///< largest error of the mapped time itself
};

Errors measure(DeviceClock& clock, const std::vector<Packet>& packets, double from_s) {
    std::vector<double> received, mapped, error;
    const Packet* before = nullptr;
    double mapped_before_s = 0;
    for (const Packet& packet : packets) {
        const double mapped_s = to_s(clock.host_time(packet.count, timestamp_from_s(packet.received_s)));
        EXPECT_LE(mapped_s, packet.received_s + 1e-9);
        EXPECT_GE(mapped_s, mapped_before_s);
        if (before && before->taken_s > packets.front().taken_s + from_s) {
            const double dt_s = packet.taken_s - before->taken_s;
            received.push_back(packet.received_s - before->received_s - dt_s);
            mapped.push_back(mapped_s - mapped_before_s - dt_s);
            error.push_back(mapped_s - packet.taken_s);
        }
        before = &packet;
        mapped_before_s = mapped_s;
    }
    const auto [least, most] = std::minmax_element(error.begin(), error.end());
    return {rms(received), rms(mapped), *most, -*least};
}

struct Transport {
    std::string name;
    double (*delay)(double, Random&);
    double offset_s; ///< largest error of the times themselves: what the packets that came soonest still waited
};

class Jitter : public testing::TestWithParam<Transport> {};

/// RMS errors of dt, measured with these seeds after 10 s, receive stamps -> mapped: exponential 5.5 ms -> 0.2 us, USB
/// frames 18 to 290 us -> 0.9 us, bursts 7.4 ms -> 3.8 us: 27 times less where there is least to win, else 1900 times.
TEST_P(Jitter, DoesNotEnterTheTimeBetweenSamples) {
    for (const std::uint64_t seed : {1u, 2u, 3u})
        for (const double drift : {-100e-6, 0.0, 50e-6}) {
            DeviceClock clock{1.0 / 200, 16}; // wraps around twice
            const auto packets = simulate({.drift = drift, .lost = 0.02}, 400, seed, GetParam().delay);
            const Errors errors = measure(clock, packets, 10);
            EXPECT_LT(20 * errors.mapped_dt_s, errors.received_dt_s) << seed;
            EXPECT_LT(std::max(errors.late_s, errors.early_s), GetParam().offset_s) << seed;
            EXPECT_NEAR(clock.drift(), drift, 1e-6) << seed;
            EXPECT_EQ(clock.beginnings(), 1u);
        }
}

INSTANTIATE_TEST_SUITE_P(Transports, Jitter,
                         testing::Values(Transport{"Exponential", exponential_5_ms, 50e-6},
                                         Transport{"UsbFrames", frames_1_ms, 600e-6},
                                         Transport{"Bursts", bursts_16_ms, 1.2e-3}),
                         [](const auto& instance) { return instance.param.name; });

/// `second` follows when `first` is over, on the host's clock; the errors are those of the second.
Errors measure_after(DeviceClock& clock, const std::vector<Packet>& first, const std::vector<Packet>& second) {
    measure(clock, first, 0);
    return measure(clock, second, 10);
}

TEST(DeviceClock, ARestartedDeviceIsFollowedAtOnce) {
    DeviceClock clock{1.0 / 200, 32};
    const auto before = simulate({.bits = 32}, 100, 1, exponential_5_ms);
    const auto after =
        simulate({.start_s = 1102.7, .bits = 32}, 100, 2, exponential_5_ms); // counts from the start again
    const Errors errors = measure_after(clock, before, after);
    EXPECT_EQ(clock.beginnings(), 2u);
    EXPECT_LT(20 * errors.mapped_dt_s, errors.received_dt_s);
}

TEST(DeviceClock, AJumpOfTheCounterIsNoticed) {
    for (const int jump : {-400, -60, 60, 400}) {
        DeviceClock clock{1.0 / 200, 16};
        auto before = simulate({}, 100, 1, exponential_5_ms);
        std::vector<Packet> after(before.begin() + 10000, before.end());
        before.resize(10000);
        for (Packet& packet : after) packet.count = (packet.count + static_cast<std::uint64_t>(jump)) & 0xFFFF;
        const Errors errors = measure_after(clock, before, after);
        EXPECT_EQ(clock.beginnings(), 2u) << jump;
        EXPECT_LT(20 * errors.mapped_dt_s, errors.received_dt_s) << jump;
        EXPECT_LT(errors.late_s, 100e-6) << jump;
    }
}

/// Samples that the device itself skipped, without counting them: its counter falls back against the host's clock.
TEST(DeviceClock, ACounterThatStoodStillIsNoticedWithinASecond) {
    DeviceClock clock{1.0 / 200, 16};
    auto packets = simulate({}, 100, 1, exponential_5_ms);
    packets.erase(packets.begin() + 10000, packets.begin() + 10060);
    for (std::size_t i = 10000; i < packets.size(); ++i) packets[i].count = (packets[i].count - 60) & 0xFFFF;
    const std::vector<Packet> before(packets.begin(), packets.begin() + 10000);
    const std::vector<Packet> after(packets.begin() + 10000, packets.end());
    measure(clock, before, 0);
    EXPECT_LT(measure(clock, after, 1).early_s, 0.01);
    EXPECT_EQ(clock.beginnings(), 2u);
}

TEST(DeviceClock, AStallOfTheHostIsNoRestart) {
    DeviceClock clock{1.0 / 200, 16};
    const auto stall = [](double taken_s, Random& random) {
        const double in_minute_s = std::fmod(taken_s, 60);
        return taken_s + std::max(0.9 - in_minute_s, 0.0) + std::exponential_distribution{1 / 0.001}(random);
    };
    const Errors errors = measure(clock, simulate({}, 400, 4, stall), 10);
    EXPECT_EQ(clock.beginnings(), 1u);
    EXPECT_LT(errors.mapped_dt_s, 1e-6);
}

TEST(DeviceClock, ALongSilenceIsBridgedOverManyWraps) {
    DeviceClock clock{1.0 / 200, 9}; // wraps around every 2.6 s
    const auto packets = simulate({.bits = 9}, 700, 1, exponential_5_ms);
    const std::vector<Packet> before(packets.begin(), packets.begin() + 10000);
    const std::vector<Packet> after(packets.end() - 10000, packets.end());
    EXPECT_LT(measure_after(clock, before, after).late_s, 100e-6);
    EXPECT_EQ(clock.beginnings(), 1u);
}

/// A rate in the settings that is not the device's, or a poor resonator: about the times of reception are left.
TEST(DeviceClock, AWrongTickDoesNoGreatHarm) {
    for (const double factor : {0.01, 0.5, 0.995, 1.005, 2.0, 100.0}) {
        DeviceClock clock{factor / 200, 16};
        const Errors errors = measure(clock, simulate({}, 60, 1, exponential_5_ms), 0);
        EXPECT_LT(errors.early_s, 0.6) << factor;
    }
}

TEST(DeviceClock, WhateverComesItSaysNoFutureAndNothingBackwards) {
    EXPECT_TRUE(rc::check([](const std::vector<std::pair<std::uint64_t, std::int64_t>>& packets, bool narrow) {
        DeviceClock clock{1e-4, narrow ? 16u : 64u};
        Timestamp newest{}, said{};
        std::uint64_t beginnings = 0;
        for (const auto& [count, received_ns] : packets) {
            const Timestamp received = timestamp_from_ns(std::abs(received_ns / 2));
            newest = clock.beginnings() == 0 ? received : std::max(newest, received);
            const Timestamp mapped = clock.host_time(count, received);
            RC_ASSERT(mapped <= newest);
            RC_ASSERT(mapped >= said || clock.beginnings() != beginnings);
            said = mapped;
            beginnings = clock.beginnings();
        }
    }));
}

TEST(DeviceClock, ResetForgets) {
    DeviceClock clock{0.01, 16};
    const Timestamp late = timestamp_from_s(5), early = timestamp_from_s(1);
    EXPECT_EQ(clock.host_time(7, late), late);
    clock.reset();
    EXPECT_EQ(clock.host_time(7, early), early);
}

} // namespace
} // namespace locus::device_clock_test
