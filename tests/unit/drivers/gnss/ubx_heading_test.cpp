// NAV-RELPOSNED of a u-blox with two antennas.
#include "drivers/gnss/ubx.h"
#include "drivers/gnss/ubx_messages.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>

namespace locus::gnss::ubx {
namespace {

using test::Collector;

Collector decode_heading(const std::vector<std::uint8_t>& bytes) {
    const UbxSettings settings{address(7)};
    Collector sink;
    make_ubx(&settings)->decode(test::bytes_packet(bytes), sink);
    return sink;
}

/// Of a moving base, its cycles fixed: the two antennas 1.0523 m apart.
RelativePosition good_relative() {
    RelativePosition relative;
    relative.time_of_week_ms = 560117000;
    relative.length_cm = 105;
    relative.length_rest_1e4_m = 23;
    relative.heading_1e5_deg = 12'345'678;
    relative.sigma_heading_1e5_deg = 35'000;
    relative.flags = 0b1'0011'0111;
    return relative;
}

TEST(UbxHeading, TwoAntennasTellAHeading) {
    const auto headings = decode_heading(encode(good_relative())).all<Heading>();
    ASSERT_EQ(headings.size(), 1u);
    EXPECT_EQ(headings[0].tag, address(7));
    EXPECT_DOUBLE_EQ(headings[0].heading_deg, 123.45678);
    EXPECT_FLOAT_EQ(headings[0].sigma_deg, 0.35f);
    EXPECT_FLOAT_EQ(headings[0].baseline_m, 1.0523f);
}

// Offsets of the fields in UBX-NAV-RELPOSNED as u-blox's interface description of the ZED-F9P has them (version 1).
TEST(UbxHeading, FieldsOfARelativePositionLieWhereTheyShould) {
    std::vector<std::uint8_t> payload(64);
    payload[0] = 1;
    payload[4] = 0x10;                   // iTOW
    payload[20] = 105;                   // relPosLength
    payload[24] = 0x40, payload[25] = 1; // relPosHeading
    payload[35] = 0xE9;                  // relPosHPLength, signed
    payload[52] = 9;                     // accHeading
    payload[60] = 0x37, payload[61] = 1; // flags
    const auto relative = parse_relative_position(payload);
    ASSERT_TRUE(relative);
    EXPECT_EQ(relative->time_of_week_ms, 16u);
    EXPECT_EQ(relative->length_cm, 105);
    EXPECT_EQ(relative->heading_1e5_deg, 320);
    EXPECT_EQ(relative->length_rest_1e4_m, -23);
    EXPECT_EQ(relative->sigma_heading_1e5_deg, 9u);
    EXPECT_EQ(relative->flags, 0x137u);
    EXPECT_EQ(encode(*relative), frame(RelativePosition::id, payload));
}

TEST(UbxHeading, ALineToABaseStationAndOneNotSettledAreNoHeading) {
    for (const unsigned missing : {0u, 2u, 4u, 5u, 8u}) { // fix, way valid, cycles fixed, base moves, heading valid
        RelativePosition doubtful = good_relative();
        doubtful.flags &= ~(1u << missing);
        const Collector sink = decode_heading(encode(doubtful));
        EXPECT_EQ(sink.frames, 1);
        EXPECT_TRUE(sink.items.empty()) << missing;
        EXPECT_TRUE(sink.refusals.empty());
    }
    const Collector older = decode_heading(frame(RelativePosition::id, std::vector<std::uint8_t>(40)));
    EXPECT_EQ(older.frames, 1) << "of a NEO-M8P: no heading in it";
    EXPECT_TRUE(older.refusals.empty());
}

TEST(UbxHeading, RefusesHeadingsBeyondATurn) {
    for (const std::int32_t heading : {-1, 36'000'001, INT32_MIN, INT32_MAX}) {
        RelativePosition relative = good_relative();
        relative.heading_1e5_deg = heading;
        EXPECT_EQ(decode_heading(encode(relative)).refusals, std::vector{Refusal::out_of_range});
    }
}

TEST(UbxHeading, AHeadingThatAFixHasOvertakenIsDatedByItsEpoch) {
    const UbxSettings settings{address(7)};
    const auto decoder = make_ubx(&settings);
    Collector sink;
    NavPvt pvt;
    pvt.valid = 7;
    pvt.fix_type = 3;
    pvt.flags = 1;
    for (const std::uint32_t ms : {0u, 100u, 200u}) {
        pvt.time_of_week_ms = 560117000 + ms;
        decoder->decode(test::bytes_packet(encode(pvt), timestamp_from_ns(1'000'000ll * (5000 + ms))), sink);
    }
    RelativePosition late = good_relative();
    late.time_of_week_ms = 560117100;
    decoder->decode(test::bytes_packet(encode(late), timestamp_from_ns(5'230'000'000)), sink);
    ASSERT_EQ(sink.items.size(), 4u);
    EXPECT_EQ(sink.items[3].time, sink.items[1].time);
}

} // namespace
} // namespace locus::gnss::ubx
