#include "drivers/uwb/nlink.h"

#include "drivers/uwb/nlink_messages.h"
#include "tests/examples/decoder_example.h"
#include "tests/examples/nlink_frames.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>

#include <cmath>

namespace locus::uwb::nlink {
namespace {

namespace real = examples::nlink_frames;
using examples::Chunk;
using examples::from_hex;
using test::Collector;

template <class Kind>
Kind parsed(std::string_view hex) {
    return std::get<Kind>(parse(from_hex(hex)).value());
}

Collector decoded(const Chunk& bytes, const NlinkSettings& settings = {}) {
    Collector sink;
    make_nlink(&settings)->decode(test::bytes_packet(bytes), sink);
    return sink;
}

struct Expected {
    unsigned anchor;
    unsigned tag;
    double range_m;
    float first_path_power_dbm = unknown_f;
    float rx_power_dbm = unknown_f;
};

bool same(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

void expect_ranges(const Collector& sink, const std::vector<Expected>& expected) {
    std::vector<Range> ranges;
    for (const auto& item : sink.items)
        if (const auto* range = std::get_if<Range>(&item.observation)) ranges.push_back(*range);
    ASSERT_EQ(ranges.size(), expected.size());
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        EXPECT_EQ(ranges[i].anchor, address(expected[i].anchor)) << i;
        EXPECT_EQ(ranges[i].tag, address(expected[i].tag)) << i;
        EXPECT_NEAR(ranges[i].range_m, expected[i].range_m, 1e-9) << i;
        EXPECT_TRUE(same(ranges[i].first_path_power_dbm, expected[i].first_path_power_dbm)) << i;
        EXPECT_TRUE(same(ranges[i].rx_power_dbm, expected[i].rx_power_dbm)) << i;
        EXPECT_EQ(ranges[i].line_of_sight, LineOfSight::unknown);
    }
}

TEST(Nlink, ReadsTheRealAnchorFrame) {
    const auto frame = parsed<AnchorFrame>(real::anchor_frame0);
    EXPECT_EQ(frame.sender, (Sender{Role::console, 0, 33313, 32000, 4995}));
    ASSERT_EQ(frame.tags.size(), 2u);
    EXPECT_EQ(frame.tags[0], (AnchorFrame::Tag{0, Role::tag, {2895, 2419, -263}, {364, 334, 490, 493}}));
    EXPECT_EQ(frame.tags[1], (AnchorFrame::Tag{2, Role::tag, {2435, 2399, -1117}, {318, 298, 530, 531}}));
    expect_ranges(decoded(from_hex(real::anchor_frame0)), {{0, 0, 3.64},
                                                           {1, 0, 3.34},
                                                           {2, 0, 4.90},
                                                           {3, 0, 4.93},
                                                           {0, 2, 3.18},
                                                           {1, 2, 2.98},
                                                           {2, 2, 5.30},
                                                           {3, 2, 5.31}});
}

void expect_near(const std::array<float, 3>& values, const std::array<float, 3>& expected) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(values[i], expected[i], 1e-5f) << i;
}

TEST(Nlink, ReadsTheRealTagFrame) {
    const auto frame = parsed<TagFrame>(real::tag_frame0);
    EXPECT_EQ(frame.sender, (Sender{Role::tag, 1, 44556, 71627, 4948}));
    EXPECT_EQ(frame.motion.position_mm, (std::array{2702, -91, 1000}));
    EXPECT_EQ(frame.motion.velocity_tenth_mmps, (std::array{-38, -6, 0}));
    EXPECT_EQ(frame.distance_mm, (std::array{3125, 5539, 6861, 4684, 0, 0, 0, 0}));
    expect_near(frame.motion.angular_rate_radps, {0.02767f, 0.008514f, -0.045762f});
    expect_near(frame.motion.specific_force_mps2, {0.251265f, 9.74908f, -0.040681f});
    EXPECT_EQ(frame.motion.angle_centidegrees, (std::array<std::int16_t, 3>{14449, 9717, -1468}));
    EXPECT_NEAR(frame.motion.quaternion[0], -0.656777f, 1e-5f);
    EXPECT_NEAR(frame.motion.quaternion[3], 0.0512801f, 1e-5f);
    EXPECT_EQ(frame.motion.position_error_cm, (std::array<std::uint8_t, 3>{11, 16, 255}));

    const Collector sink = decoded(from_hex(real::tag_frame0));
    expect_ranges(sink, {{0, 1, 3.125}, {1, 1, 5.539}, {2, 1, 6.861}, {3, 1, 4.684}});
    const auto& imu = std::get<ImuSample>(sink.items.back().observation);
    EXPECT_EQ(imu.tag, address(1));
    EXPECT_NEAR(imu.specific_force_mps2[1], 9.74908, 1e-5);
    EXPECT_NEAR(imu.angular_rate_radps[2], -0.045762, 1e-5);
}

TEST(Nlink, ReadsTheRealDataFrame) {
    const auto frame = parsed<DataFrame>(real::node_frame0);
    EXPECT_EQ(frame.role, Role::anchor);
    ASSERT_EQ(frame.nodes.size(), 2u);
    EXPECT_EQ(frame.nodes[0].data.size(), 9u);
    EXPECT_EQ(frame.nodes[1].data.size(), 37u);
    const Collector sink = decoded(from_hex(real::node_frame0));
    EXPECT_EQ(sink.frames, 1);
    EXPECT_TRUE(sink.items.empty());
}

TEST(Nlink, ReadsTheRealPositionsFrame) {
    const auto frame = parsed<PositionsFrame>(real::node_frame1);
    EXPECT_EQ(frame.sender, (Sender{Role::console, 0, 34304, 33000, 4936}));
    ASSERT_EQ(frame.nodes.size(), 2u);
    EXPECT_EQ(frame.nodes[0], (PositionsFrame::Node{Role::tag, 0, {2911, 2438, -101}}));
    EXPECT_EQ(frame.nodes[1], (PositionsFrame::Node{Role::tag, 2, {2451, 2373, -828}}));
    EXPECT_EQ(decoded(from_hex(real::node_frame1)).frames, 1);
}

TEST(Nlink, ReadsTheRealNodeFrame2) {
    const auto frame = parsed<RangesFrame>(real::node_frame2);
    EXPECT_EQ(frame.sender, (Sender{Role::tag, 1, 9157, 1926842, 4973}));
    EXPECT_EQ(frame.motion.position_mm, (std::array{2782, -33, 1000}));
    EXPECT_EQ(frame.motion.velocity_tenth_mmps, (std::array{-6, 26, 0}));
    EXPECT_EQ(frame.motion.angle_centidegrees, (std::array<std::int16_t, 3>{9069, 9193, -8848}));
    EXPECT_EQ(frame.motion.position_error_cm, (std::array<std::uint8_t, 3>{6, 9, 255}));
    EXPECT_EQ(frame.nodes[0].system_time_ms, 1926822u);

    const Collector sink = decoded(from_hex(real::node_frame2));
    expect_ranges(sink, {{0, 1, 3.179, -88.5f, -79.5f},
                         {1, 1, 5.548, -90.f, -80.5f},
                         {2, 1, 6.728, -101.f, -79.5f},
                         {3, 1, 4.651, -99.f, -80.f}});
    const auto& imu = std::get<ImuSample>(sink.items.back().observation);
    EXPECT_NEAR(imu.specific_force_mps2[0], 0.224942, 1e-5);
    EXPECT_NEAR(imu.specific_force_mps2[1], 9.73712, 1e-5);
    EXPECT_NEAR(imu.angular_rate_radps[1], 0.00958, 1e-5);
}

TEST(Nlink, ReadsTheRealNodeFrame3) {
    EXPECT_EQ(parsed<RangesFrame>(real::node_frame3).sender, (Sender{Role::tag, 1, 463352, 7262319, 4954}));
    expect_ranges(decoded(from_hex(real::node_frame3)), {{0, 1, 2.850, -90.5f, -79.5f},
                                                         {1, 1, 6.051, -91.f, -80.f},
                                                         {2, 1, 7.304, -85.f, -79.5f},
                                                         {3, 1, 5.350, -92.f, -80.f}});
}

TEST(Nlink, ReadsTheRealConsoleFrame) {
    const auto frame = parsed<ConsoleFrame>(real::node_frame4);
    EXPECT_EQ(frame.sender.local_time_ms, 105870u);
    EXPECT_EQ(frame.sender.voltage_mv, 4456);
    ASSERT_EQ(frame.tags.size(), 2u);
    EXPECT_EQ(frame.tags[0], (ConsoleFrame::Tag{2, 88, 4})); // 4.4 V
    EXPECT_EQ(frame.tags[1], (ConsoleFrame::Tag{5, 70, 4})); // 3.5 V
    expect_ranges(decoded(from_hex(real::node_frame4)), {{0, 2, 2.445},
                                                         {1, 2, 1.748},
                                                         {2, 2, 2.038},
                                                         {3, 2, 1.709},
                                                         {0, 5, 2.744},
                                                         {1, 5, 1.427},
                                                         {2, 5, 2.408},
                                                         {3, 5, 1.347}});
}

TEST(Nlink, ReadsTheRealAoaFrame) {
    const auto frame = parsed<RangesFrame>(real::aoa_node_frame0);
    EXPECT_EQ(frame.sender, (Sender{Role::tag, 0, 160702, 0, 4847}));
    const std::array<std::int16_t, 4> angles{2850, 173, 971, -4967};
    ASSERT_EQ(frame.nodes.size(), angles.size());
    for (std::size_t i = 0; i < angles.size(); ++i) EXPECT_EQ(frame.nodes[i].angle_centidegrees, angles[i]);
    expect_ranges(decoded(from_hex(real::aoa_node_frame0)), {{0, 0, 0.767, -81.5f, -79.5f},
                                                             {1, 0, 0.770, -82.f, -79.5f},
                                                             {2, 0, 1.004, -82.5f, -80.f},
                                                             {3, 0, 1.416, -81.5f, -80.f}});
}

TEST(Nlink, ReadsTheRealTofSense) {
    EXPECT_EQ(parsed<TofSense>(real::tof_sense), (TofSense{0, 17858, 640, 0, 8, 255}));
    EXPECT_EQ(decoded(from_hex(real::tof_sense)).frames, 1);
}

/// A frame 3 of one unit that lists another, 2.5 m away.
Collector pair(Role sender, Role other) {
    RangesFrame frame{Mark::node_frame3, {sender, 4, 0, 0, 0}, {}, {}};
    frame.nodes.push_back({other, 9, 2500, 0, 0, 160, 0});
    return decoded(encode(frame), {100, 200});
}

TEST(Nlink, RolesTellWhichSideIsTheAnchor) {
    expect_ranges(pair(Role::tag, Role::anchor), {{109, 204, 2.5, unknown_f, -80.f}});
    expect_ranges(pair(Role::anchor, Role::tag), {{104, 209, 2.5, unknown_f, -80.f}});
    expect_ranges(pair(Role::node, Role::anchor), {{109, 204, 2.5, unknown_f, -80.f}});
    EXPECT_TRUE(pair(Role::anchor, Role::anchor).items.empty());
    EXPECT_TRUE(pair(Role::console, Role::tag).items.empty());
    EXPECT_TRUE(pair(Role::anchor, Role::console).items.empty());
    const auto peers = pair(Role::node, Role::node).all<PeerRange>();
    ASSERT_EQ(peers.size(), 1u);
    EXPECT_EQ(peers[0].tag_a, address(204));
    EXPECT_EQ(peers[0].tag_b, address(209));
    EXPECT_DOUBLE_EQ(peers[0].range_m, 2.5);
}

TEST(Nlink, ZeroIsNotMeasuredAndNegativeIsImpossible) {
    RangesFrame frame{Mark::node_frame3, {Role::tag, 1, 0, 0, 0}, {}, {}};
    frame.nodes.push_back({Role::anchor, 0, 0, 0, 0, 0, 0});
    frame.nodes.push_back({Role::anchor, 1, -1, 0, 0, 0, 0});
    frame.nodes.push_back({Role::anchor, 2, 1, 0, 0, 0, 0});
    const Collector sink = decoded(encode(frame));
    EXPECT_EQ(sink.refusals, std::vector<Refusal>{Refusal::out_of_range});
    expect_ranges(sink, {{2, 1, 0.001}});
}

TEST(Nlink, AnImuThatIsAbsentOrBrokenGivesNoSample) {
    TagFrame frame;
    EXPECT_TRUE(decoded(encode(frame)).items.empty());
    frame.motion.specific_force_mps2 = {0, std::numeric_limits<float>::infinity(), 0};
    const Collector sink = decoded(encode(frame));
    EXPECT_TRUE(sink.items.empty());
    EXPECT_EQ(sink.refusals, std::vector<Refusal>{Refusal::out_of_range});
}

TEST(Nlink, StampIsWhenTheFrameBegan) {
    Collector sink;
    const Chunk bytes = from_hex(real::node_frame3);
    test::default_decoder("nlink")->decode(test::bytes_packet(bytes, timestamp_from_ns(1'000'000), Duration{100}),
                                           sink);
    EXPECT_EQ(to_ns(sink.items[0].time), 1'000'000 - 50 * 100);
}

TEST(Nlink, SaysWhatIsWrongWithAFrame) {
    const auto refused = [](std::string_view hex, std::size_t at, std::uint8_t value) {
        Chunk bytes = from_hex(hex);
        bytes[at] = value;
        const Collector sink = decoded(bytes);
        EXPECT_TRUE(sink.items.empty());
        return sink.refusals.empty() ? Refusal::count_ : sink.refusals[0];
    };
    EXPECT_EQ(refused(real::node_frame3, 24, 0), Refusal::bad_checksum);
    EXPECT_EQ(refused(real::node_frame3, 2, 0x33), Refusal::malformed); // length does not fit the count
    EXPECT_EQ(refused(real::node_frame4, 3, 0x40), Refusal::too_long);
    EXPECT_EQ(refused(real::node_frame3, 1, 0x0A), Refusal::unknown_type);
    EXPECT_EQ(refused(real::anchor_frame0, 895, 0xED), Refusal::bad_checksum);
    EXPECT_EQ(refused(real::anchor_frame0, 894, 7), Refusal::malformed); // no such role
    EXPECT_EQ(refused(real::anchor_frame0, 3, 7), Refusal::malformed);
}

TEST(Nlink, CountsInsideAFrameAreNotBelieved) {
    Chunk bytes = from_hex(real::node_frame4);
    bytes[25] = 200; // ranges of the first tag
    bytes.back() = static_cast<std::uint8_t>(bytes.back() + 200 - 4);
    const Collector sink = decoded(bytes);
    EXPECT_TRUE(sink.items.empty());
    ASSERT_FALSE(sink.refusals.empty());
    EXPECT_EQ(sink.refusals[0], Refusal::malformed);
}

} // namespace
} // namespace locus::uwb::nlink
