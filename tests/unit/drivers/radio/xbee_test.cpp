// The frames of protocols.md E-7.
#include "drivers/radio/xbee.h"

#include "tests/examples/decoder_example.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace locus::radio {
namespace {

using examples::from_hex;

const auto rx16 = from_hex("7E 00 08 81 12 34 2D 00 42 30 31 68");
const auto rx64 = from_hex("7E 00 0E 80 00 13 A2 00 40 A1 B2 C3 2D 00 42 30 31 A4");
const auto zigbee = from_hex("7E 00 0F 90 00 13 A2 00 40 A1 B2 C3 12 34 01 42 30 31 7A");
const auto strength_answer = from_hex("7E 00 06 88 01 44 42 00 2D C3");
const auto at_db = from_hex("7E 00 04 08 01 44 42 70");

struct Module {
    explicit Module(XbeeSettings settings = {}) {
        settings.receiver = address(9);
        decoder = make_xbee(&settings);
    }
    void hear(const examples::Chunk& bytes, Timestamp time = {}) {
        decoder->decode(test::bytes_packet(bytes, time), sink);
    }
    std::unique_ptr<Decoder> decoder;
    test::Collector sink;
};

TEST(Xbee, PacketsWithTheirStrength) {
    Module module;
    module.hear(rx16);
    module.hear(rx64);
    const auto strengths = module.sink.all<SignalStrength>();
    ASSERT_EQ(strengths.size(), 2u);
    EXPECT_EQ(strengths[0].transmitter, address(0x1234));
    EXPECT_EQ(strengths[1].transmitter, address(0x0013A20040A1B2C3));
    EXPECT_EQ(strengths[0].receiver, address(9));
    EXPECT_EQ(strengths[0].rssi_dbm, -45);
}

TEST(Xbee, ZigbeeFirmwareIsAskedAfterEachPacket) {
    Module module;
    EXPECT_FALSE(module.decoder->request({}));
    module.hear(zigbee, Timestamp{std::chrono::seconds{1}});
    const auto request = module.decoder->request({});
    ASSERT_TRUE(request);
    EXPECT_TRUE(std::ranges::equal(request->data, at_db));
    EXPECT_FALSE(module.decoder->request({})) << "once";
    module.hear(strength_answer, Timestamp{std::chrono::seconds{2}});
    ASSERT_EQ(module.sink.items.size(), 1u);
    EXPECT_EQ(module.sink.all<SignalStrength>()[0].transmitter, address(0x0013A20040A1B2C3));
    EXPECT_EQ(module.sink.items[0].time, Timestamp{std::chrono::seconds{1}}) << "of the packet, not of the answer";
    module.hear(strength_answer);
    EXPECT_EQ(module.sink.items.size(), 1u) << "an answer to nobody's question";
}

TEST(Xbee, EscapedFramesCountUnescapedBytes) {
    XbeeSettings settings;
    settings.escaped = true;
    Module module{settings};
    module.hear(from_hex("7E 00 08 81 7D 31 7D 5D 2D 00 42 30 31 20"));
    ASSERT_EQ(module.sink.all<SignalStrength>().size(), 1u);
    EXPECT_EQ(module.sink.all<SignalStrength>()[0].transmitter, address(0x117D));
}

TEST(Xbee, ShortAndUnknownFrames) {
    Module module;
    module.hear(xbee_frame(from_hex("81 12")));
    module.hear(xbee_frame(from_hex("8A 06")));
    EXPECT_EQ(module.sink.refusals, std::vector{Refusal::malformed});
    EXPECT_EQ(module.sink.frames, 1) << "a modem status is a frame without a measurement";
}

TEST(Xbee, WhatIsEncodedIsDecoded) {
    rc::check([](std::uint64_t source, bool escaped) {
        XbeeFrame frame{*rc::gen::elementOf(std::vector<std::uint8_t>{0x80, 0x81, 0x88}), {}, {}};
        if (frame.type != 0x88) frame.source = frame.type == 0x81 ? source & 0xFFFF : source;
        frame.rssi_dbm = -*rc::gen::inRange(0, 256);
        XbeeSettings settings;
        settings.escaped = escaped;
        Module module{settings};
        if (frame.type == 0x88) module.hear(xbee_frame(from_hex("90 0000000000000007 1234 01"), escaped));
        module.hear(encode(frame, escaped));
        const auto strengths = module.sink.all<SignalStrength>();
        RC_ASSERT(strengths.size() == 1u);
        RC_ASSERT(strengths[0].rssi_dbm == static_cast<float>(*frame.rssi_dbm));
        RC_ASSERT(strengths[0].transmitter == address(frame.source.value_or(7)));
    });
}

} // namespace
} // namespace locus::radio
