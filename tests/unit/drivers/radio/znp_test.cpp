// The frames of protocols.md E-7.
#include "drivers/radio/znp.h"

#include "tests/examples/decoder_example.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace locus::radio {
namespace {

using examples::from_hex;

test::Collector hear_znp(const examples::Chunk& bytes) {
    const ZnpSettings settings{address(9), -95, 0.4};
    test::Collector sink;
    make_znp(&settings)->decode(test::bytes_packet(bytes), sink);
    return sink;
}

TEST(Znp, FindsAPacketBehindGarbage) {
    const auto sink = hear_znp(from_hex(
        "5F 1B 25 FE 1B 44 81 00 00 08 00 D4 17 01 01 00 37 00 99 B2 DB 00 00 07 08 7A 0A 00 00 20 F3 D4 17 1D A0"));
    const auto strengths = sink.all<SignalStrength>();
    ASSERT_EQ(strengths.size(), 1u);
    EXPECT_EQ(strengths[0].transmitter, address(0x17D4));
    EXPECT_EQ(strengths[0].receiver, address(9));
    EXPECT_FLOAT_EQ(strengths[0].rssi_dbm, -95 + 0.4f * 55);
    EXPECT_EQ(sink.refusals, std::vector{Refusal::garbage});
}

TEST(Znp, ReadsWhatThePacketSays) {
    const auto incoming = parse_znp_incoming(
        from_hex("FE 1B 44 81 00 00 08 00 D4 17 01 01 00 37 00 99 B2 DB 00 00 07 08 7A 0A 00 00 20 F3 D4 17 1D A0"));
    EXPECT_EQ(incoming, (ZnpIncoming{8, 0x17D4, 55, 0x00DBB299}));
}

TEST(Znp, OtherCommandsAreFramesAndAWrongChecksumIsNone) {
    EXPECT_EQ(
        hear_znp(from_hex("FE 03 61 08 00 01 55 3E FE 02 61 03 06 01 67 FE 0E 61 02 02 00 02 06 03 D9 14 34 01 02 "
                          "00 00 00 00 92"))
            .frames,
        3);
    const auto sink = hear_znp(from_hex("FE 03 61 08 00 01 55 3F"));
    EXPECT_EQ(sink.frames, 0);
    EXPECT_EQ(sink.refusals.at(0), Refusal::bad_checksum);
}

TEST(Znp, WhatIsEncodedIsDecoded) {
    rc::check([](std::uint16_t cluster, std::uint16_t source, std::uint8_t quality, std::uint32_t timestamp) {
        const ZnpIncoming incoming{cluster, source, quality, timestamp};
        RC_ASSERT(parse_znp_incoming(encode(incoming)) == incoming);
    });
}

} // namespace
} // namespace locus::radio
