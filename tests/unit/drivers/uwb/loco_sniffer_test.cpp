// The payloads of protocols.md E-4, and differences at a listener among simulated anchors whose clocks all go wrong.
#include "drivers/uwb/loco_sniffer.h"

#include "drivers/uwb/loco_tdoa.h"
#include "tests/examples/decoder_example.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <random>

namespace locus::uwb::loco {
namespace {

using examples::Chunk;
using examples::from_hex;

constexpr double ticks_per_metre = 128 * 499.2e6 / 299792458;
constexpr double antenna_delay_ticks = 32951.36;

const Chunk tdoa3_example =
    from_hex("30 15 00 22 5F 3A 02 01 A2 56 04 10 39 E1 84 02 40 22 11 00 37 F0 01 00 00 80 3F 00 "
             "00 00 40 00 00 20 40");
const Chunk tdoa2_example = from_hex(
    "22 10 11 12 00 00 00 00 00 00 00 00 10 56 04 10 04 89 07 20 02 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 "
    "00 00 00 00 00 00 00 E1 84 00 00 00 00 00 00 00 00 00 00 00 00");

TEST(LocoPackets, Tdoa3) {
    const auto payload = parse(tdoa3_example);
    ASSERT_TRUE(payload);
    const auto& packet = std::get<Tdoa3>(*payload);
    EXPECT_EQ(packet.packet, 0x15);
    EXPECT_EQ(packet.tx_ticks_in_sender, 0x3A5F2200u);
    ASSERT_EQ(packet.remote_count, 2u);
    EXPECT_EQ(packet.remotes[0], (Tdoa3::Remote{1, 0x22, 0x39100456, 34017}));
    EXPECT_EQ(packet.remotes[1], (Tdoa3::Remote{2, 0x40, 0x37001122, 0}));
    EXPECT_NEAR((packet.remotes[0].distance_ticks - antenna_delay_ticks) / ticks_per_metre, 5.00, 0.005);
}

TEST(LocoPackets, Tdoa2) {
    const auto payload = parse(tdoa2_example);
    ASSERT_TRUE(payload);
    const auto& packet = std::get<Tdoa2>(*payload);
    EXPECT_EQ(packet.packets, (std::array<std::uint8_t, 8>{0x10, 0x11, 0x12}));
    EXPECT_EQ(packet.ticks_in_sender[0], 0x10000000u);
    EXPECT_EQ(packet.ticks_in_sender[1], 0x04100456u);
    EXPECT_EQ(packet.ticks_in_sender[2], 0x02200789u);
    EXPECT_EQ(packet.distance_ticks[1], 0x84E1);
}

TEST(LocoPackets, CutOffOrTooManyIsNone) {
    for (std::size_t length = 0; length < 21; ++length)
        EXPECT_FALSE(parse(wire::Bytes{tdoa3_example}.first(length))) << length;
    EXPECT_FALSE(parse(wire::Bytes{tdoa2_example}.first(56)));
    Chunk many = tdoa3_example;
    many[6] = 17;
    many.resize(400);
    EXPECT_FALSE(parse(many));
    EXPECT_FALSE(parse(from_hex("05 00 00")));
}

TEST(LocoPackets, WhatIsEncodedIsParsed) {
    rc::check([](std::uint32_t tx, std::uint8_t number, const std::vector<std::uint16_t>& distances) {
        Tdoa3 packet{static_cast<std::uint8_t>(number & 0x7F), tx, {}, std::min(distances.size(), most_remotes)};
        for (std::size_t i = 0; i < packet.remote_count; ++i)
            packet.remotes[i] = {static_cast<std::uint8_t>(i * 3), static_cast<std::uint8_t>(i), tx - 77u,
                                 distances[i]};
        RC_ASSERT(parse(encode(packet)) == Payload{packet});
        Tdoa2 other;
        for (std::size_t i = 0; i < 8; ++i) other.packets[i] = number, other.ticks_in_sender[i] = tx + 1;
        other.distance_ticks[*rc::gen::inRange(0, 8)] = 34017;
        RC_ASSERT(parse(encode(other)) == Payload{other});
    });
}

TEST(LocoSniffer, BothFormsSayTheSame) {
    const Sniffed packet{0x0A3A5F2200, 1, 0xFF, tdoa3_example};
    std::array<std::uint8_t, longest_payload> buffer{};
    const Chunk record = encode_record(packet);
    const std::string line = encode_line(packet);
    EXPECT_EQ(line.substr(0, 34), "From 01 to ff @0a3a5f2200: 3015002");
    for (const auto& back : {parse_record(record), parse_line(line.substr(0, line.size() - 2), buffer)}) {
        ASSERT_TRUE(back);
        EXPECT_EQ(back->rx_ticks, packet.rx_ticks);
        EXPECT_EQ(back->from, 1);
        EXPECT_EQ(back->to, 0xFF);
        EXPECT_EQ(Chunk(back->payload.begin(), back->payload.end()), tdoa3_example);
    }
}

TEST(LocoSniffer, LinesAndRecordsOneAfterTheOther) {
    const Sniffed packet{77, 1, 0xFF, tdoa3_example};
    Chunk stream = encode_record(packet);
    const std::string text = "\r\nLPS node, sniffer\r\n" + encode_line(packet);
    stream.insert(stream.end(), text.begin(), text.end());
    stream.insert(stream.end(), stream.begin(), stream.end());
    LocoSnifferSettings settings;
    test::Collector sink;
    make_loco_sniffer(&settings)->decode(test::bytes_packet(stream), sink);
    EXPECT_EQ(sink.frames, 4);
    EXPECT_EQ(sink.refusals, (std::vector{Refusal::garbage, Refusal::garbage}));
}

/// A clock: ticks = offset + true seconds * (1 + error) * rate.
struct Clock {
    double offset_ticks, error;
    std::uint64_t at(double true_s) const {
        return static_cast<std::uint64_t>(std::llround(offset_ticks + true_s * (1 + error) * 128 * 499.2e6));
    }
};

/// Anchors in a hall and a listener, in true time; packets in turn.
struct Hall {
    std::vector<std::array<double, 3>> anchors{{0, 0, 0}, {12, 0, 3}, {12, 9, 0}, {0, 9, 3}};
    std::array<double, 3> listener{4, 3, 1};
    std::vector<Clock> clocks{{4.2e9, 19e-6}, {1.0e9, -20e-6}, {3.9e12, 3e-6}, {8e10, 11e-6}};
    Clock own{1.0995e12, -17e-6}; // wraps around in the first milliseconds

    struct Heard {
        std::uint8_t packet = 0;
        double received_s[4]{};
    };
    std::vector<Heard> heard{4};

    static double metres(const std::array<double, 3>& a, const std::array<double, 3>& b) {
        return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    }
    static double flight_s(double distance_m) { return distance_m / 299792458 + antenna_delay_ticks / (128 * 499.2e6); }
    double difference_m(std::size_t a, std::size_t b) const {
        return metres(anchors[b], listener) - metres(anchors[a], listener);
    }

    std::pair<std::uint64_t, Tdoa3> send(std::size_t from, double true_s) {
        Tdoa3 packet{heard[from].packet = static_cast<std::uint8_t>((heard[from].packet + 1) & 0x7F),
                     static_cast<std::uint32_t>(clocks[from].at(true_s)),
                     {},
                     0};
        for (std::size_t other = 0; other < anchors.size(); ++other) {
            if (other == from) continue;
            const double distance_m = metres(anchors[from], anchors[other]);
            heard[from].received_s[other] = true_s + flight_s(distance_m);
            packet.remotes[packet.remote_count++] = {
                static_cast<std::uint8_t>(other), heard[other].packet,
                static_cast<std::uint32_t>(clocks[from].at(heard[other].received_s[from])),
                static_cast<std::uint16_t>(std::llround(distance_m * ticks_per_metre + antenna_delay_ticks))};
        }
        const double received_s = true_s + flight_s(metres(anchors[from], listener));
        return {own.at(received_s) & 0xFFFFFFFFFF, packet};
    }
};

TEST(LocoTdoa, DifferencesAreThoseOfTheHall) {
    Hall hall;
    DifferenceMaker maker;
    int told = 0;
    for (int i = 0; i < 400; ++i) {
        const auto from = static_cast<std::size_t>(i % 4);
        const auto [rx, packet] = hall.send(from, 0.01 + i * 2.1e-3);
        const auto difference = maker.hear(static_cast<std::uint8_t>(from), rx, packet);
        if (!difference) continue;
        ++told;
        EXPECT_EQ(difference->anchor_b, address(from));
        EXPECT_EQ(difference->anchor_a, address((from + 3) % 4));
        EXPECT_NEAR(difference->difference_m, hall.difference_m((from + 3) % 4, from), 0.02);
    }
    EXPECT_EQ(told, 400 - 4 * 2); // the third packet of each anchor gives its second interval
}

TEST(LocoTdoa, LostPacketsGiveNothingWrong) {
    Hall hall;
    DifferenceMaker maker;
    std::mt19937 random{20261122};
    int told = 0;
    for (int i = 0; i < 4000; ++i) {
        const auto from = static_cast<std::size_t>(random() % 4);
        const auto [rx, packet] = hall.send(from, 0.01 + i * 2.5e-3);
        if (random() % 3 == 0) continue;
        const auto difference = maker.hear(static_cast<std::uint8_t>(from), rx, packet);
        if (!difference) continue;
        ++told;
        EXPECT_NEAR(difference->difference_m, hall.difference_m(number(difference->anchor_a), from), 0.05) << i;
    }
    EXPECT_GT(told, 2000);
}

TEST(LocoTdoa, AnAnchorThatBeginsAgainIsSilentUntilItsRateIsKnown) {
    Hall hall;
    DifferenceMaker maker;
    for (int i = 0; i < 400; ++i) {
        if (i == 200) hall.clocks[2].offset_ticks += 123456789;
        const auto from = static_cast<std::size_t>(i % 4);
        const auto [rx, packet] = hall.send(from, 0.01 + i * 2.1e-3);
        const auto difference = maker.hear(static_cast<std::uint8_t>(from), rx, packet);
        const bool begun_anew = from == 2 && i >= 200 && i < 208;
        EXPECT_FALSE(difference && begun_anew) << i;
        const double wanted_m = hall.difference_m((from + 3) % 4, from);
        EXPECT_NEAR(difference ? difference->difference_m : wanted_m, wanted_m, 0.02) << i;
    }
}

} // namespace
} // namespace locus::uwb::loco
