#include "drivers/uwb/dwm1001_tlv.h"

#include "tests/examples/decoder_example.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace locus::uwb::dwm1001 {
namespace {

using namespace std::chrono_literals;
using examples::Chunk;
using examples::from_hex;
using test::Collector;

/// protocols.md E-3: a tag with two anchors.
constexpr std::string_view tag_reply =
    "40 01 00 41 0D 36 06 00 00 72 06 00 00 F6 04 00 00 2C 49 29 02 2F 2F A2 08 00 00 64 EA 0B 00 00 78 0A 00 00 00 00 "
    "00 00 64 9D 2C 56 09 00 00 64 D8 FF FF FF 5E 0B 00 00 00 00 00 00 64";
/// protocols.md E-3, TV.
constexpr std::string_view position_only = "40 01 00 41 0D 79 00 00 00 32 00 00 00 FB 00 00 00 64";

const Dwm1001TlvSettings settings{address(7), address(9), 0.1};

Collector decoded(const Chunk& bytes) {
    Collector sink;
    make_dwm1001_tlv(&settings)->decode(test::bytes_packet(bytes), sink);
    return sink;
}

TEST(Dwm1001Tlv, ReadsTheReplyOfATag) {
    const auto reply = parse_tlv_reply(from_hex(tag_reply));
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->position, (TlvPosition{{1590, 1650, 1270}, 44}));
    ASSERT_EQ(reply->distances.size(), 2u);
    EXPECT_EQ(reply->distances[0], (TlvDistance{0x2F2F, 2210, 100, {{3050, 2680, 0}, 100}}));
    EXPECT_EQ(reply->distances[1], (TlvDistance{0x2C9D, 2390, 100, {{-40, 2910, 0}, 100}}));
    EXPECT_EQ(encode(*reply), from_hex(tag_reply));

    const auto ranges = decoded(from_hex(tag_reply)).all<Range>();
    ASSERT_EQ(ranges.size(), 2u);
    EXPECT_EQ(ranges[0].anchor, address(0x2F2F));
    EXPECT_EQ(ranges[0].tag, address(7));
    EXPECT_DOUBLE_EQ(ranges[0].range_m, 2.210);
    EXPECT_DOUBLE_EQ(ranges[1].range_m, 2.390);
}

TEST(Dwm1001Tlv, ReadsTheVectorsOfTheUnitTest) {
    EXPECT_EQ(parse_tlv_reply(from_hex(position_only))->position, (TlvPosition{{121, 50, 251}, 100}));
    Chunk bytes = from_hex(position_only);
    const Chunk list = from_hex("49 15 01 01 0A 05 00 00 00 64 01 02 00 00 05 00 00 00 FB 00 00 00 0F");
    bytes.insert(bytes.end(), list.begin(), list.end());
    EXPECT_EQ(parse_tlv_reply(bytes)->distances.at(0), (TlvDistance{0x0A01, 5, 100, {{513, 5, 251}, 15}}));
}

TEST(Dwm1001Tlv, AnAnchorTellsDistancesToTags) {
    TlvReply reply;
    reply.from = TlvReply::From::anchor;
    reply.distances.push_back({0x1122334455667788, 1500, 90, {}});
    const auto ranges = decoded(encode(reply)).all<Range>();
    ASSERT_EQ(ranges.size(), 1u);
    EXPECT_EQ(ranges[0].anchor, address(9));
    EXPECT_EQ(ranges[0].tag, address(0x1122334455667788));
    EXPECT_DOUBLE_EQ(ranges[0].range_m, 1.5);
}

TEST(Dwm1001Tlv, APositionAloneEndsWhereTheNextReplyBegins) {
    Chunk bytes = from_hex(position_only);
    const Chunk next = from_hex(tag_reply);
    bytes.insert(bytes.end(), next.begin(), next.end());
    const Collector sink = decoded(bytes);
    EXPECT_EQ(sink.frames, 2);
    EXPECT_EQ(sink.items.size(), 2u);
    EXPECT_TRUE(sink.refusals.empty());
}

TEST(Dwm1001Tlv, AnErrorIsAFrameWithoutMeasurement) {
    const Collector sink = decoded(from_hex("40 01 04"));
    EXPECT_EQ(sink.frames, 1);
    EXPECT_TRUE(sink.items.empty());
}

TEST(Dwm1001Tlv, EveryLengthAndLimitIsChecked) {
    const auto first_refusal = [](std::size_t at, std::uint8_t value) {
        Chunk bytes = from_hex(tag_reply);
        bytes[at] = value;
        const Collector sink = decoded(bytes);
        EXPECT_TRUE(sink.items.empty()) << at;
        return sink.refusals.empty() ? Refusal::count_ : sink.refusals[0];
    };
    EXPECT_EQ(first_refusal(0, 0x41), Refusal::garbage);
    EXPECT_EQ(first_refusal(1, 0x02), Refusal::garbage);
    EXPECT_EQ(first_refusal(2, 0x06), Refusal::garbage);
    EXPECT_EQ(first_refusal(3, 0x42), Refusal::malformed);
    EXPECT_EQ(first_refusal(4, 0x0C), Refusal::malformed);
    EXPECT_EQ(first_refusal(17, 101), Refusal::malformed); // per cent
    EXPECT_EQ(first_refusal(18, 0x47), Refusal::malformed);
    EXPECT_EQ(first_refusal(18, 0x48), Refusal::malformed); // 13 bytes each do not fit
    EXPECT_EQ(first_refusal(19, 0x28), Refusal::malformed);
    EXPECT_EQ(first_refusal(20, 3), Refusal::malformed);
    EXPECT_EQ(first_refusal(27, 101), Refusal::malformed);
}

TEST(Dwm1001Tlv, ZeroIsNotMeasuredAndAKilometreIsImpossible) {
    TlvReply reply;
    reply.from = TlvReply::From::tag;
    for (const std::uint32_t mm : {0u, 1'000'001u, 1'000'000u}) reply.distances.push_back({1, mm, 100, {}});
    const Collector sink = decoded(encode(reply));
    EXPECT_EQ(sink.items.size(), 1u);
    EXPECT_EQ(sink.refusals, std::vector<Refusal>{Refusal::out_of_range});
}

TEST(Dwm1001Tlv, AsksAgainAfterThePeriodOrAfterALostAnswer) {
    const auto decoder = make_dwm1001_tlv(&settings);
    Collector sink;
    const auto asks = [&](Duration at) { return decoder->request(Timestamp{at}).has_value(); };
    const auto first = decoder->request(Timestamp{1s});
    ASSERT_TRUE(first);
    EXPECT_EQ(Chunk(first->data.begin(), first->data.end()), from_hex("0C 00"));
    EXPECT_FALSE(asks(1150ms)); // still waiting
    decoder->decode(test::bytes_packet(from_hex(tag_reply)), sink);
    EXPECT_TRUE(asks(1150ms));
    decoder->decode(test::bytes_packet(from_hex("40 01 00 41 0D 79")), sink); // the rest is lost
    EXPECT_FALSE(asks(1349ms));
    EXPECT_TRUE(asks(1350ms));
    decoder->decode(test::bytes_packet(from_hex(tag_reply)), sink);
    EXPECT_EQ(sink.items.size(), 4u);
    EXPECT_EQ(sink.refusals, std::vector<Refusal>{Refusal::malformed});
    EXPECT_FALSE(asks(1449ms));
    EXPECT_TRUE(asks(1450ms));
    decoder->reset();
    EXPECT_TRUE(asks(1451ms));
}

TEST(Dwm1001Tlv, APauseEndsAnAnswer) {
    const auto decoder = make_dwm1001_tlv(&settings);
    Collector sink;
    const Chunk whole = from_hex(tag_reply);
    Chunk damaged = whole; // would else take its last byte from the next
    damaged.erase(damaged.begin() + 40);
    decoder->decode(test::bytes_packet(damaged, Timestamp{1s}), sink);
    decoder->decode(test::bytes_packet(whole, Timestamp{1200ms}), sink);
    EXPECT_EQ(sink.items.size(), 2u);
    EXPECT_EQ(sink.refusals, std::vector<Refusal>{Refusal::malformed});
    decoder->decode(test::bytes_packet(from_hex(position_only), Timestamp{1400ms}), sink);
    decoder->decode(test::bytes_packet(whole, Timestamp{1600ms}), sink);
    EXPECT_EQ(sink.frames, 3);
    EXPECT_EQ(sink.refusals.size(), 1u);
}

TlvPosition any_position() {
    TlvPosition position;
    for (auto& mm : position.position_mm) mm = *rc::gen::arbitrary<std::int32_t>();
    position.quality_percent = *rc::gen::inRange<std::uint8_t>(0, 101);
    return position;
}

TlvReply any_reply() {
    TlvReply reply;
    reply.error = *rc::gen::inRange<std::uint8_t>(0, 6);
    if (reply.error != 0) return reply;
    reply.position = any_position();
    reply.from = *rc::gen::element(TlvReply::From::nobody, TlvReply::From::tag, TlvReply::From::anchor);
    const bool of_tag = reply.from == TlvReply::From::tag;
    if (reply.from == TlvReply::From::nobody) return reply;
    for (int i = *rc::gen::inRange(0, of_tag ? 13 : 17); i > 0; --i)
        reply.distances.push_back({of_tag ? *rc::gen::arbitrary<std::uint16_t>() : *rc::gen::arbitrary<std::uint64_t>(),
                                   *rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange<std::uint8_t>(0, 101),
                                   of_tag ? any_position() : TlvPosition{}});
    return reply;
}

TEST(Dwm1001Tlv, ReadsBackWhatItWrites) {
    EXPECT_TRUE(rc::check([] {
        const TlvReply reply = any_reply();
        Chunk bytes = encode(reply);
        RC_ASSERT(parse_tlv_reply(bytes) == reply);
        const std::size_t size = bytes.size();
        bytes.push_back(0x40); // the next
        const Look look = TlvFormat::look(bytes);
        RC_ASSERT(look.kind == Look::Kind::frame);
        RC_ASSERT(look.length == size);
    }));
}

} // namespace
} // namespace locus::uwb::dwm1001
