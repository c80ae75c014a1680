// Any message, written and read again.
#include "drivers/uwb/nlink_messages.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace locus::uwb::nlink {
namespace {

template <class T>
T any() {
    return *rc::gen::arbitrary<T>();
}
std::int32_t any_int24() { return *rc::gen::inRange(-(1 << 23), 1 << 23); }
Role any_role() { return static_cast<Role>(*rc::gen::inRange(0, 7)); }
std::uint32_t any_id(Mark mark) {
    return mark == Mark::node_frame5 || mark == Mark::node_frame6 ? any<std::uint32_t>() : any<std::uint8_t>();
}
std::size_t any_count(std::size_t last) { return *rc::gen::inRange<std::size_t>(0, last + 1); }
Sender any_sender(Mark mark) {
    return {any_role(), any_id(mark), any<std::uint32_t>(), any<std::uint32_t>(), any<std::uint16_t>()};
}
Motion any_motion() {
    Motion motion;
    for (auto* values : {&motion.position_mm, &motion.velocity_tenth_mmps})
        for (auto& value : *values) value = any_int24();
    for (auto& value : motion.position_error_cm) value = any<std::uint8_t>();
    for (auto& value : motion.angular_rate_radps) value = any<float>();
    for (auto& value : motion.specific_force_mps2) value = any<float>();
    for (auto& value : motion.angle_centidegrees) value = any<std::int16_t>();
    for (auto& value : motion.quaternion) value = any<float>();
    return motion;
}

Message any_anchor_frame() {
    AnchorFrame frame{any_sender(Mark::anchor_frame0), {}};
    for (std::size_t i = any_count(AnchorFrame::slots); i > 0; --i) {
        AnchorFrame::Tag tag{*rc::gen::inRange<std::uint8_t>(0, 255), any_role(), {any_int24(), 0, any_int24()}, {}};
        for (auto& distance : tag.distance_cm) distance = any<std::uint16_t>();
        frame.tags.push_back(tag);
    }
    return frame;
}

Message any_ranges_frame(Mark mark) {
    RangesFrame frame{mark, any_sender(mark), mark == Mark::node_frame2 ? any_motion() : Motion{}, {}};
    for (std::size_t i = any_count(255); i > 0; --i) {
        RangesFrame::Node node{any_role(), any_id(mark), any_int24(), 0, any<std::uint8_t>(), any<std::uint8_t>(), 0};
        if (mark == Mark::aoa_node_frame0) node.angle_centidegrees = any<std::int16_t>();
        if (mark == Mark::node_frame2) node.system_time_ms = any<std::uint32_t>();
        frame.nodes.push_back(node);
    }
    return frame;
}

Message any_console_frame() {
    ConsoleFrame frame{any_sender(Mark::node_frame4), {}, {}};
    for (std::size_t i = any_count(30); i > 0; --i) {
        const auto count = static_cast<std::uint8_t>(any_count(30));
        frame.tags.push_back({any<std::uint8_t>(), any<std::uint8_t>(), count});
        for (unsigned k = 0; k < count; ++k) frame.ranges.push_back({any<std::uint8_t>(), any_int24()});
    }
    return frame;
}

constexpr std::array<std::uint8_t, 5> user_data{0x55, 0, 1, 2, 3};

Message any_data_frame(Mark mark) {
    DataFrame frame{mark, any_role(), any_id(mark), {}};
    for (std::size_t i = any_count(255); i > 0; --i)
        frame.nodes.push_back({any_role(), any_id(mark), std::span{user_data}.first(any_count(user_data.size()))});
    return frame;
}

Message any_tag_frame() {
    TagFrame frame{any_sender(Mark::tag_frame0), any_motion(), {}};
    for (auto& distance : frame.distance_mm) distance = any_int24();
    return frame;
}

Message any_positions_frame() {
    PositionsFrame frame{any_sender(Mark::node_frame1), {}};
    for (std::size_t i = any_count(200); i > 0; --i)
        frame.nodes.push_back({any_role(), any<std::uint8_t>(), {any_int24(), any_int24(), any_int24()}});
    return frame;
}

Message any_message() {
    switch (*rc::gen::inRange(0, 11)) {
    case 0:
        return any_anchor_frame();
    case 1:
        return any_tag_frame();
    case 2:
        return any_positions_frame();
    case 3:
        return any_console_frame();
    case 4:
        return any_data_frame(Mark::node_frame0);
    case 5:
        return any_data_frame(Mark::node_frame6);
    case 6:
        return TofSense{any<std::uint8_t>(), any<std::uint32_t>(), any_int24(), 1, any<std::uint16_t>(), 2};
    case 7:
        return any_ranges_frame(Mark::node_frame2);
    case 8:
        return any_ranges_frame(Mark::aoa_node_frame0);
    case 9:
        return any_ranges_frame(Mark::node_frame5);
    default:
        return any_ranges_frame(Mark::node_frame3);
    }
}

TEST(NlinkMessages, ReadsBackWhatItWrites) {
    EXPECT_TRUE(rc::check([] {
        const Message message = any_message();
        const auto bytes = encode(message);
        const Look look = Format::look(bytes);
        RC_ASSERT(look.kind == Look::Kind::frame);
        RC_ASSERT(look.length == bytes.size());
        RC_ASSERT(parse(bytes) == message);
    }));
}

} // namespace
} // namespace locus::uwb::nlink
