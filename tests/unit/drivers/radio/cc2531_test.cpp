// The record of protocols.md E-7.
#include "drivers/radio/cc2531.h"

#include "drivers/radio/mac_header.h"
#include "tests/examples/decoder_example.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace locus::radio {
namespace {

using examples::Chunk;
using examples::from_hex;

test::Collector hear_cc2531(const Chunk& bytes) {
    const Cc2531Settings settings{address(9)};
    test::Collector sink;
    make_cc2531(&settings)->decode(test::bytes_packet(bytes), sink);
    return sink;
}

const Chunk example = from_hex("00 10 00 00 48 E8 01 0B 41 88 02 34 12 FF FF 00 00 1C EA");

Chunk heard(const MacHeader& header, bool crc_good = true) {
    const Chunk frame = encode(header);
    return encode(Cc2531Record{1, frame, -20, crc_good, 100});
}

TEST(Cc2531, TheExample) {
    const auto record = parse_cc2531(example);
    EXPECT_EQ(record.timestamp_ticks, 32'000'000u); // 1.0 s
    EXPECT_EQ(record.raw_rssi, 28);
    EXPECT_TRUE(record.crc_good);
    EXPECT_EQ(record.correlation, 106);
    const auto strengths = hear_cc2531(example).all<SignalStrength>();
    ASSERT_EQ(strengths.size(), 1u);
    EXPECT_EQ(strengths[0].rssi_dbm, -45);
    EXPECT_EQ(strengths[0].transmitter, address(0));
    EXPECT_EQ(strengths[0].receiver, address(9));
}

TEST(Cc2531, APacketWithADamagedSumIsNotBelieved) {
    Chunk damaged = example;
    damaged.back() &= 0x7F;
    const auto sink = hear_cc2531(damaged);
    EXPECT_TRUE(sink.items.empty());
    EXPECT_EQ(sink.refusals, std::vector{Refusal::bad_checksum});
}

TEST(Cc2531, LongAddressesAndThoseWithoutAny) {
    const MacHeader::Node coordinator{0x1234, 0, false}, lamp{0x1234, 0x00124B0001020304, true};
    const auto strengths = hear_cc2531(heard({1, 7, coordinator, lamp})).all<SignalStrength>();
    ASSERT_EQ(strengths.size(), 1u);
    EXPECT_EQ(strengths[0].transmitter, address(0x00124B0001020304));
    const auto acknowledgement = hear_cc2531(heard({2, 7, {}, {}}));
    EXPECT_EQ(acknowledgement.frames, 1);
    EXPECT_TRUE(acknowledgement.items.empty());
}

TEST(Cc2531, TicksAreFramesAndTwoLengthsMustAgree) {
    EXPECT_EQ(hear_cc2531(from_hex("01 04 00 00 00 00 00")).frames, 1);
    Chunk wrong = example;
    ++wrong[1];
    EXPECT_TRUE(hear_cc2531(wrong).items.empty());
}

TEST(MacHeader, WhatIsEncodedIsParsed) {
    rc::check([](std::uint8_t sequence, std::uint16_t pan, std::uint64_t number) {
        const auto node = [&](std::uint16_t in) -> std::optional<MacHeader::Node> {
            const bool is_long = *rc::gen::arbitrary<bool>();
            if (*rc::gen::inRange(0, 4) == 0) return std::nullopt;
            return MacHeader::Node{in, is_long ? number : number & 0xFFFF, is_long};
        };
        const auto other = *rc::gen::element(pan, static_cast<std::uint16_t>(pan + 1));
        const MacHeader header{*rc::gen::element<std::uint8_t>(0, 1, 2, 3), sequence, node(pan), node(other)};
        const Chunk bytes = encode(header);
        RC_ASSERT(parse_mac_header(bytes) == header);
        RC_ASSERT(!parse_mac_header(wire::Bytes{bytes}.first(bytes.size() - 1)));
    });
}

TEST(MacHeader, NewerVersionsAreNotGuessedAt) {
    EXPECT_FALSE(parse_mac_header(from_hex("41 A8 02 34 12 FF FF 00 00"))); // version 2
    EXPECT_FALSE(parse_mac_header(from_hex("41 84 02 34 12 FF FF 00 00"))); // destination mode 1
}

TEST(Cc2531, WhatIsEncodedIsDecoded) {
    rc::check([](std::uint32_t ticks, std::int8_t rssi, bool good) {
        const auto payload = *rc::gen::resize(122, rc::gen::arbitrary<Chunk>());
        Chunk frame = encode(MacHeader{1, 3, MacHeader::Node{1, 2, false}, MacHeader::Node{1, 3, false}});
        frame.insert(frame.end(), payload.begin(),
                     payload.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(payload.size(), 100)));
        const Cc2531Record record{ticks, frame, rssi, good, 99};
        const auto bytes = encode(record);
        const Cc2531Record back = parse_cc2531(bytes);
        RC_ASSERT(back.timestamp_ticks == ticks && back.raw_rssi == rssi && back.crc_good == good);
        RC_ASSERT(Chunk(back.frame.begin(), back.frame.end()) == frame);
        RC_ASSERT(hear_cc2531(bytes).items.size() == static_cast<std::size_t>(good));
    });
}

} // namespace
} // namespace locus::radio
