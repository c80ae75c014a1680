// Every message of protocols.md E-4e as the vendor's documents (DOC) or our own arithmetic (CALC) have it, and that
// what is written is read again.
#include "drivers/uwb/pulson/messages.h"

#include "drivers/uwb/pulson/lengths.h"
#include "drivers/uwb/pulson/neighbors.h"
#include "drivers/uwb/pulson/radio_info.h"
#include "tests/examples/decoder_example.h"
#include "tests/unit/drivers/uwb/pulson/computed_range.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace locus::uwb::pulson {
namespace {

using examples::from_hex;

/// Fills a message with anything; arrays and tails are the test's business.
struct AnyFields {
    template <class... Fields>
    void operator()(Fields&&... fields) {
        (one(fields), ...);
    }
    template <std::integral T>
    void one(T& value) {
        value = *rc::gen::arbitrary<T>();
    }
    void one(std::array<char, 32>& text) {
        for (char& letter : text) letter = *rc::gen::arbitrary<char>();
    }
    void one(const Reserved&) {}
    template <class Items, class Count>
    void one(const Counted<Items, Count>&) {}
    template <class View, class Count>
    void one(const Tail<View, Count>&) {}
};

template <class Message>
Message any_message() {
    Message message;
    AnyFields fields;
    Message::layout(fields, message);
    message.type = *rc::gen::elementOf(Message::types);
    return message;
}

template <class Message>
Message any_database() {
    Message message = any_message<Message>();
    message.count = static_cast<std::uint8_t>(*rc::gen::inRange<std::size_t>(0, Message::room + 1));
    AnyFields fields;
    for (std::size_t i = 0; i < message.count; ++i)
        std::decay_t<decltype(message.neighbors[i])>::layout(fields, message.neighbors[i]);
    return message;
}

template <class Message>
void expect_comes_back(const Message& message) {
    const auto bytes = encode(message);
    RC_ASSERT(parse<Message>(bytes) == message);
    const auto rule = length_rule(message.type);
    RC_ASSERT(rule && rule->allows(wire::Bytes{bytes}));
    RC_ASSERT(!parse<Message>(wire::Bytes{bytes}.first(bytes.size() - 1)));
}

TEST(PulsonMessages, ComeBackAsTheyWent) {
    EXPECT_TRUE(rc::check([] {
        expect_comes_back(any_message<Confirm>());
        expect_comes_back(any_message<FullRange>());
        expect_comes_back(any_message<SmallRange>());
        expect_comes_back(any_message<EchoedRange>());
        expect_comes_back(any_message<Config>());
        expect_comes_back(any_message<StatusInfo>());
    }));
}

TEST(PulsonMessages, DatabasesComeBackAsTheyWent) {
    EXPECT_TRUE(rc::check([] {
        expect_comes_back(any_database<FullNeighbors>());
        expect_comes_back(any_database<SmallNeighbors>());
    }));
}

template <class Message, class View, class Count>
void expect_tail_comes_back(View view, Count count, std::size_t item, std::size_t most) {
    auto message = any_message<Message>();
    const auto items = *rc::gen::inRange<std::size_t>(0, most + 1);
    const auto tail = *rc::gen::container<std::vector<std::uint8_t>>(items * item, rc::gen::arbitrary<std::uint8_t>());
    message.*view = tail;
    message.*count = static_cast<std::decay_t<decltype(message.*count)>>(items);
    const auto bytes = encode(message);
    const auto back = parse<Message>(bytes);
    RC_ASSERT(back && std::ranges::equal((*back).*view, tail) && encode(*back) == bytes);
    message.*count = static_cast<std::decay_t<decltype(message.*count)>>(items + 1);
    RC_ASSERT(!parse<Message>(encode(message)));
}

TEST(PulsonMessages, TailsComeBackAndTheirCountIsNotBelieved) {
    EXPECT_TRUE(rc::check([] {
        expect_tail_comes_back<RangeRequest>(&RangeRequest::data, &RangeRequest::data_size, 1, 30);
        expect_tail_comes_back<DataInfo>(&DataInfo::data, &DataInfo::data_size, 1, 30);
        expect_tail_comes_back<ScanInfo>(&ScanInfo::samples, &ScanInfo::sample_count, 4, 10);
    }));
    const auto data_info = encode(DataInfo{});
    for (std::size_t size = 0; size < data_info.size(); ++size)
        EXPECT_FALSE(parse<DataInfo>(wire::Bytes{data_info}.first(size))) << size;
    EXPECT_FALSE(parse<FullScan>(std::vector<std::uint8_t>(1448)));
    FullScan scan{.source = 5};
    const std::vector<std::uint8_t> samples(350 * 4, 1);
    scan.samples = samples;
    EXPECT_EQ(encode(scan).size(), 1452u);
    EXPECT_EQ(parse<FullScan>(encode(scan))->source, 5u);
}

TEST(PulsonMessages, ADatabaseWithMoreThanThereIsRoomForIsNone) {
    FullNeighbors database;
    auto bytes = encode(database);
    bytes[4] = 33;
    bytes.resize(bytes.size() + 33 * 44);
    EXPECT_FALSE(parse<FullNeighbors>(bytes));
    EXPECT_FALSE(length_rule(0x3203)->allows(wire::Bytes{bytes}));
}

TEST(PulsonMessages, ConfigOfTheVendorsDocument) {
    const auto config = parse<Config>(
        from_hex("01 02 00 01 00 00 00 12 00 07 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 08 93 CC 00 00 00 00"));
    ASSERT_TRUE(config);
    EXPECT_EQ(config->node, 18u);
    EXPECT_EQ(config->integration, 7);
    EXPECT_EQ(config->timestamp_ms, 562124u);
    EXPECT_EQ(config->status, 0u);
}

TEST(PulsonMessages, StatusOfTheVendorsDocument) {
    const auto info = parse<StatusInfo>(from_hex(
        "F1010001 020A0000 020500A3 0C150818 5A000274 41000400 0000009C 3135303731352D72633239 000000 00000000000000"
        "00000000000000 00000000 00000000"));
    ASSERT_TRUE(info);
    EXPECT_EQ(info->application, (Version{2, 10, 0}));
    EXPECT_EQ(info->kernel, (Version{2, 5, 163}));
    EXPECT_EQ(info->firmware, 0x0C);
    EXPECT_EQ(info->firmware_year, 0x15);
    EXPECT_EQ(info->firmware_month, 0x08);
    EXPECT_EQ(info->firmware_day, 0x18);
    EXPECT_EQ(info->serial, 0x5A000274u);
    EXPECT_EQ(info->board_revision, 'A');
    EXPECT_EQ(info->model, 4);
    EXPECT_EQ(info->temperature_quarter_c, 39 * 4);
    EXPECT_STREQ(info->package.data(), "150715-rc29");
    EXPECT_EQ(info->status, 0u);
}

TEST(PulsonMessages, RangeRequestAndItsConfirm) {
    EXPECT_EQ(encode(RangeRequest{.message = 7, .responder = 101, .antenna = 0}),
              from_hex("00 03 00 07 00 00 00 65 00 00 00 00"));
    EXPECT_EQ(parse<Confirm>(from_hex("01 03 00 07 00 00 00 00")), (Confirm{.message = 7}));
}

TEST(PulsonMessages, FullRange) {
    const FullRange& expected = computed_range;
    const auto bytes =
        from_hex("02 01 00 07 00 00 00 65 00 00 00 14 00 00 14 72 00 00 14 B4 00 00 14 78 00 15 00 96 00 19 "
                 "FF 88 00 28 01 00 00 08 00 08 00 D2 10 68 00 00 02 3B 00 01 E2 40");
    EXPECT_EQ(parse<FullRange>(bytes), expected);
    EXPECT_EQ(encode(expected), bytes);
}

TEST(PulsonMessages, SmallRange) {
    EXPECT_EQ(parse<SmallRange>(from_hex("02 05 00 07 00 00 00 65 02 0B 02 01 00 00")),
              (SmallRange{.message = 7, .responder = 101, .range_cm = 523, .sigma_cm = 2, .parts = precise}));
}

} // namespace
} // namespace locus::uwb::pulson
