// The frames of protocols.md E-4b.
#include "drivers/uwb/cwru_can.h"

#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <linux/can.h>
#include <rapidcheck.h>

#include <limits>

namespace locus::uwb {
namespace {

using namespace std::chrono_literals;

struct CwruNode {
    explicit CwruNode(double poll_period_s = 0) {
        const CwruSettings settings{1, address(7), 100, poll_period_s};
        decoder = make_cwru_can(&settings);
    }
    void hear(const CanFrame& frame) { decoder->decode(frame.packet({}), sink); }
    std::unique_ptr<Decoder> decoder;
    test::Collector sink;
};

TEST(CwruCan, BothLayouts) {
    CwruNode node;
    node.hear({1, 8, {0x00, 0x12, 0x00, 0x00, 0x50, 0x40, 0x00, 0x00}});
    node.hear({1, 6, {0x12, 0x04, 0x00, 0x00, 0x50, 0x40}});
    const auto ranges = node.sink.all<Range>();
    ASSERT_EQ(ranges.size(), 2u);
    for (const Range& range : ranges) {
        EXPECT_EQ(range.anchor, address(0x12 + 100));
        EXPECT_EQ(range.tag, address(7));
        EXPECT_EQ(range.range_m, 3.25);
    }
}

TEST(CwruCan, OtherValuesAndOtherNodesAreNoRanges) {
    CwruNode node;
    node.hear({1, 6, {0x12, 0x05, 0x00, 0x00, 0x50, 0x40}}); // a power
    node.hear({2, 6, {0x12, 0x04, 0x00, 0x00, 0x50, 0x40}});
    node.hear({1 | CAN_RTR_FLAG, 8, {}});
    EXPECT_TRUE(node.sink.items.empty());
    EXPECT_TRUE(node.sink.refusals.empty());
    EXPECT_EQ(node.sink.frames, 1);
}

TEST(CwruCan, RefusesWhatCannotBe) {
    CwruNode node;
    node.hear({1, 7, {}});
    for (const float distance_m : {std::numeric_limits<float>::quiet_NaN(), -1.0f, 0.0f, 1e9f})
        node.hear(encode(CwruDistance{3, distance_m}, 1, true));
    EXPECT_TRUE(node.sink.items.empty());
    EXPECT_EQ(node.sink.refusals.size(), 5u);
}

TEST(CwruCan, AsksWhenToldTo) {
    EXPECT_FALSE(CwruNode{}.decoder->request(Timestamp{10s}));
    CwruNode node{0.1};
    const auto question = node.decoder->request(Timestamp{10s});
    ASSERT_TRUE(question);
    EXPECT_EQ(question->can_id, 1 | CAN_RTR_FLAG);
    EXPECT_EQ(question->data.size(), 8u);
    EXPECT_FALSE(node.decoder->request(Timestamp{10s + 99ms}));
    EXPECT_TRUE(node.decoder->request(Timestamp{10s + 100ms}));
}

TEST(CwruCan, WhatIsEncodedIsParsed) {
    rc::check([](std::uint8_t anchor, std::uint16_t centimetres, bool newer) {
        const CwruDistance distance{anchor, static_cast<float>(centimetres) / 100};
        const CanFrame frame = encode(distance, 1, newer);
        RC_ASSERT(parse_cwru(std::span{frame.data}.first(frame.length)) == distance);
    });
}

} // namespace
} // namespace locus::uwb
