#include "drivers/uwb/ieee802154.h"

#include "tests/examples/decoder_example.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace locus::uwb::ieee802154 {
namespace {

using examples::from_hex;

/// protocols.md E-2: heard by Decawave's listeners, and of another's node with its FCS (REAL).
TEST(Ieee802154, ReadsTheRealFrames) {
    EXPECT_EQ(parse_blink(from_hex("c5cbf01c0010c2bf4020")), (Blink{203, 0x2040BFC210001CF0}));
    const auto sync = from_hex("c5939204b2cf86c102049204000000000400000050c03791490713000004");
    const ClockCalibration expected{147, 0x0402C186CFB20492, 0x0492, 0x0400000000, 0x001307499137C050, 0, 4, {}};
    EXPECT_EQ(parse_clock_calibration(sync), expected);
    EXPECT_EQ(encode(expected), sync);

    const auto frame =
        from_hex("41 88 e5 10 11 ff ff 05 00 30 d8 d9 43 14 ff a4 ba f5 ff ff ff fe a9 5b 11 fe 2b 71 a6 "
                 "36 14 fd 3b ff aa ff 7a ff c5 88 01 00 d7 0a 00 00 6b 6a");
    const auto body = without_fcs(frame);
    ASSERT_TRUE(body);
    const auto data = parse_data(*body);
    ASSERT_TRUE(data);
    EXPECT_EQ(data->pan, 0x1110);
    EXPECT_EQ(data->destination, 0xFFFF);
    EXPECT_EQ(data->source, 5);
    EXPECT_EQ(data->payload[0], 0x30);
    EXPECT_EQ(with_fcs(encode(*data)), frame);
}

TEST(Ieee802154, ReadsAndWritesTheComputedFrames) {
    const auto blink = from_hex("C5 2A DE CA AB 90 78 56 34 12 11 8A");
    EXPECT_EQ(with_fcs(encode(Blink{0x2A, 0x1234567890ABCADE})), blink);
    const auto poll = from_hex("41 88 05 CA DE 00 80 00 00 81 05 8C 93");
    const auto data = parse_data(without_fcs(poll).value());
    ASSERT_TRUE(data);
    EXPECT_EQ(data->pan, 0xDECA);
    EXPECT_EQ(data->destination, 0x8000);
    EXPECT_EQ(data->source, 0);
    EXPECT_EQ(data->payload[0], 0x81);
}

TEST(Ieee802154, TwoSyncPacketsTellTheDrift) {
    const auto a = parse_clock_calibration(from_hex("c5939204b2cf86c102049204000000000400000050c03791490713000004"));
    const auto b = parse_clock_calibration(from_hex("c5949204b2cf86c1020492040000000004000000500038914d0713000004"));
    EXPECT_EQ(b->sent_ticks_in_master, 0x0013074D91380050u);
    EXPECT_EQ(b->sent_ticks_in_master - a->sent_ticks_in_master, 17179885568u);
}

TEST(Ieee802154, LengthsAndChecksumsAreNotBelieved) {
    auto frame = with_fcs(encode(Blink{1, 2}));
    EXPECT_FALSE(parse_blink(frame)); // with its FCS it is 12 bytes
    for (std::size_t i = 0; i < frame.size(); ++i) {
        auto damaged = frame;
        damaged[i] ^= 0x10;
        EXPECT_FALSE(without_fcs(damaged)) << i;
    }
    EXPECT_FALSE(without_fcs({}));
    EXPECT_FALSE(parse_blink({}));
    EXPECT_FALSE(parse_data(from_hex("41 88 05 CA DE 00 80 00")));
    EXPECT_FALSE(parse_data(from_hex("41 8C 05 CA DE 00 80 00 00")));
    EXPECT_FALSE(parse_clock_calibration(std::vector<std::uint8_t>(31, 0xC5)));
}

TEST(Ieee802154, ReadsBackWhatItWrites) {
    EXPECT_TRUE(rc::check([](std::uint8_t sequence, std::uint64_t eui, std::uint16_t number, std::uint64_t ticks,
                             std::vector<std::uint8_t> payload) {
        const Blink blink{sequence, eui};
        RC_ASSERT(parse_blink(encode(blink)) == blink);
        ClockCalibration sync{sequence, eui, number, ticks, ~ticks, 1, 4, {}};
        RC_ASSERT(parse_clock_calibration(encode(sync)) == sync);
        sync.epoch_offset_us = number;
        RC_ASSERT(parse_clock_calibration(encode(sync)) == sync);
        const Data data{sequence, number, 3, 4, payload};
        const auto frame = encode(data);
        RC_ASSERT(parse_data(frame) == data);
    }));
}

} // namespace
} // namespace locus::uwb::ieee802154
