#include "drivers/slam/tum.h"

#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace locus::slam {
namespace {

using std::chrono::milliseconds;
using test::Collector;

TumSettings worn_by_seven(const char* stamps = "device") {
    TumSettings settings;
    settings.tag = address(7);
    settings.stamps = stamps;
    return settings;
}

/// The text in chunks of `size`, each received at `time`.
Collector tum_decoded(std::string_view text, const TumSettings& settings = worn_by_seven(), std::size_t size = 1000) {
    Collector sink;
    const auto decoder = make_tum(&settings);
    for (; !text.empty(); text.remove_prefix(std::min(size, text.size())))
        decoder->decode(test::bytes_packet(text.substr(0, size)), sink);
    return sink;
}

std::string at(double time_s) { return encode(TumPose{time_s, {1, 2, 3}, {0, 0, 0, 1}}); }

std::vector<std::uint32_t> segments(const std::string& text) {
    std::vector<std::uint32_t> all;
    for (const auto& odometry : tum_decoded(text).all<VisualOdometry>()) all.push_back(odometry.segment);
    return all;
}
using Segmented = std::vector<std::uint32_t>;

/// Of ORB-SLAM on fr2_desk, as evo has it.
constexpr std::string_view desk_line =
    "1311868171.331406 0.0144578 0.0064183 -0.0057602 -0.0013450 -0.0102747 -0.0080008 0.9999143";

TEST(Tum, ReadsALine) {
    const auto pose = parse_tum_pose(desk_line);
    ASSERT_TRUE(pose.has_value());
    EXPECT_DOUBLE_EQ(pose->time_s, 1311868171.331406);
    EXPECT_EQ(pose->position, (Vec3{0.0144578, 0.0064183, -0.0057602}));
    EXPECT_EQ(pose->orientation_xyzw, (std::array{-0.0013450, -0.0102747, -0.0080008, 0.9999143}));
    const auto given = tum_decoded(std::string{desk_line} + "\r\n").all<VisualOdometry>();
    ASSERT_EQ(given.size(), 1u);
    EXPECT_EQ(given[0].tag, address(7));
    EXPECT_EQ(given[0].camera, address(7)) << "whoever wears it gives it a name";
    EXPECT_EQ(given[0].segment, 0u);
    EXPECT_EQ(given[0].position_odometry, pose->position);
    EXPECT_NEAR(given[0].orientation_xyzw[3], 0.9999143, 1e-6);
}

TEST(Tum, ACameraMayHaveANameOfItsOwnAndNobodyToWearIt) {
    TumSettings settings;
    settings.camera = address(40);
    const auto given = tum_decoded(at(1), settings).all<VisualOdometry>();
    ASSERT_EQ(given.size(), 1u);
    EXPECT_EQ(given[0].camera, address(40));
    EXPECT_EQ(given[0].tag, no_address);
}

TEST(Tum, BlanksTabsAndCommasPartNumbers) {
    const TumPose expected{1.5, {1, -2, 3e-2}, {0, 0.6, 0, -0.8}};
    for (const char* line : {"1.5 1 -2 3e-2 0 0.6 0 -0.8", "  1.5\t1\t-2   0.03 0 .6 0 -.8 \t",
                             "1.5,1,-2,0.03,0,0.6,0,-0.8", "1.5, 1, -2, 0.03, 0, 0.6, 0, -0.8,"})
        EXPECT_EQ(parse_tum_pose(line), expected) << line;
}

TEST(Tum, ReadsBackWhatItWrites) {
    EXPECT_TRUE(rc::check([](std::int64_t time_us, std::array<std::int32_t, 7> parts) {
        TumPose pose;
        pose.time_s = static_cast<double>(time_us % 9'000'000'000'000'000) * 1e-6;
        for (std::size_t i = 0; i < 3; ++i) pose.position[i] = parts[i] * 1e-7;
        for (std::size_t i = 0; i < 4; ++i) pose.orientation_xyzw[i] = parts[i + 3] * 1e-7;
        std::string line = encode(pose);
        line.pop_back();
        RC_ASSERT(parse_tum_pose(line) == pose);
    }));
}

TEST(Tum, RefusesWhatIsNoPose) {
    for (const char* line : {"1 2 3", "1 0 0 0 0 0 0", "1 0 0 0 0 0 0 1 5", "1 0 0 0 0 0 0 one",
                             "time x y z qx qy qz qw", "1 0 0 0 0 0-0 1", "1 0 0 0 0 0 0 1x", "+1 0 0 0 0 0 0 1"}) {
        const Collector sink = tum_decoded(std::string{line} + "\n");
        EXPECT_EQ(sink.refusals, std::vector<Refusal>{Refusal::malformed}) << line;
        EXPECT_TRUE(sink.items.empty());
    }
    for (const char* line :
         {"1 nan 0 0 0 0 0 1", "nan 0 0 0 0 0 0 1", "1 0 -inf 0 0 0 0 1", "1 0 0 0 0 0 0 nan", "1 0 0 0 0 0 0 0",
          "1 0 0 0 0 0 0 0.98", "1 0 0 0 0.2 0 0 1", "1 0 0 2e6 0 0 0 1", "1403636579763555584 0 0 0 0 0 0 1"}) {
        const Collector sink = tum_decoded(std::string{line} + "\n");
        EXPECT_EQ(sink.refusals, std::vector<Refusal>{Refusal::out_of_range}) << line;
        EXPECT_TRUE(sink.items.empty());
    }
    const Collector sink = tum_decoded(std::string(600, '1') + "\n" + at(1));
    EXPECT_EQ(sink.refusals, std::vector<Refusal>{Refusal::too_long});
    EXPECT_EQ(sink.items.size(), 1u);
}

TEST(Tum, ARoundedAttitudeIsMadeLengthOne) {
    const auto given = tum_decoded("1 0 0 0 0.71 0 0 0.71\n").all<VisualOdometry>();
    ASSERT_EQ(given.size(), 1u);
    EXPECT_DOUBLE_EQ(given[0].orientation_xyzw[0], std::sqrt(0.5));
}

TEST(Tum, RemarksArePassedOver) {
    const Collector sink = tum_decoded("# timestamp tx ty tz qx qy qz qw\n\n \t \n" + at(1) +
                                       "#\n# lost again\n# losting\n# segments\n#segment\n" + at(2));
    EXPECT_TRUE(sink.refusals.empty());
    EXPECT_EQ(sink.frames, 2);
    EXPECT_EQ(sink.all<VisualOdometry>().at(1).segment, 0u);
}

TEST(Tum, ASlamSaysWhatIsANewSegment) {
    EXPECT_EQ(segments(at(1) + at(2) + "# lost\n" + at(3) + at(4)), (Segmented{0, 0, 1, 1}));
    EXPECT_EQ(segments("# lost\n" + at(1) + "#lost\n# lost \n" + at(2)), (Segmented{0, 1})) << "lost once";
    EXPECT_EQ(segments("# segment 4\n" + at(1) + "# segment 4\n" + at(2) + "#segment 9 of 12\n" + at(3)),
              (Segmented{0, 0, 1}));
    EXPECT_EQ(segments(at(1) + "# segment 0\n" + at(2)), (Segmented{0, 1})) << "what had no name was another map";
    EXPECT_EQ(segments(at(9) + "# lost\n" + at(1) + at(2)), (Segmented{0, 1, 1})) << "whatever the stamps then are";
}

/// The first pose of it is passed over: it could have been a stray.
TEST(Tum, StampsTellANewSegmentAsWell) {
    EXPECT_EQ(segments(at(10) + at(11) + at(2) + at(3) + at(4)), (Segmented{0, 0, 1, 1})) << "started again";
    EXPECT_EQ(segments(at(10) + at(11) + at(16.1) + at(16.2)), (Segmented{0, 0, 1})) << "silent for 5.1 s";
    EXPECT_EQ(segments(at(10) + at(11) + at(15.9) + at(16)), (Segmented{0, 0, 0, 0})) << "silent for 4.9 s";
    EXPECT_EQ(segments(at(10) + at(10) + at(11)), (Segmented{0, 0, 0})) << "said twice";
}

TEST(Tum, AStrayStampEndsNoSegment) {
    for (const double stray : {1.0, 10.5, 14.0, 99.0}) {
        const std::string text = at(10) + at(11) + at(stray) + at(12) + at(13);
        const auto all = segments(text);
        EXPECT_EQ(std::ranges::count(all, 0u), std::ssize(all)) << stray;
        EXPECT_GE(all.size(), 4u) << stray;
    }
    EXPECT_EQ(tum_decoded(at(10) + at(99) + at(11)).refusals, std::vector<Refusal>{Refusal::out_of_range});
}

TEST(Tum, ItDoesNotMatterHowLinesAreCut) {
    const std::string text = "# segment 1\n" + at(1) + at(2) + "1 2\n# lost\n" + at(3) + std::string(600, ' ') + '\n' +
                             std::string{desk_line} + "\n" + at(1311868171.4);
    const Collector whole = tum_decoded(text);
    EXPECT_EQ(whole.refusals, (std::vector{Refusal::malformed, Refusal::too_long, Refusal::out_of_range}));
    EXPECT_EQ(whole.items.size(), 4u);
    for (std::size_t size = 1; size < text.size(); ++size) {
        const Collector cut = tum_decoded(text, worn_by_seven(), size);
        EXPECT_EQ(cut.refusals, whole.refusals) << size;
        EXPECT_EQ(cut.frames, whole.frames) << size;
        ASSERT_EQ(cut.items.size(), whole.items.size()) << size;
        EXPECT_EQ(cut.all<VisualOdometry>().back().segment, 2u) << size;
    }
}

/// Thirty frames a second, each 20 to 70 ms late, in bursts at times: the errors of the times between them.
double worst_jitter_s(const char* stamps) {
    const TumSettings settings = worn_by_seven(stamps);
    const auto decoder = make_tum(&settings);
    Collector sink;
    double worst_s = 0;
    Timestamp came{};
    for (int i = 0; i < 900; ++i) {
        const Duration taken = i * milliseconds{33};
        came = std::max(came, Timestamp{taken + milliseconds{20 + i * 37 % 50 + (i % 200 < 5 ? 180 : 0)}});
        decoder->decode(test::bytes_packet(at(1e9 + to_s(taken)), came), sink);
        if (i > 200) worst_s = std::max(worst_s, std::abs(to_s(sink.items.back().time - Timestamp{taken}) - 0.02));
    }
    EXPECT_EQ(sink.items.size(), 900u);
    return worst_s;
}

TEST(Tum, StampsOfTheDeviceHaveNoJitterOfTheWay) {
    EXPECT_LT(worst_jitter_s("device"), 0.002);
    EXPECT_GT(worst_jitter_s("arrival"), 0.1);
}

TEST(Tum, StampsByArrivalLookAtNoOthers) {
    const TumSettings settings = worn_by_seven("arrival");
    const auto decoder = make_tum(&settings);
    Collector sink;
    for (const int second : {1, 2, 3, 20, 21, 22})
        decoder->decode(test::bytes_packet(at(1000 - 10 * second), timestamp_from_s(second)), sink);
    const auto all = sink.all<VisualOdometry>();
    ASSERT_EQ(all.size(), 5u);
    EXPECT_EQ(sink.items[2].time, timestamp_from_s(3));
    EXPECT_EQ(all[2].segment, 0u);
    EXPECT_EQ(sink.items[3].time, timestamp_from_s(21)) << "after the silence one is passed over";
    EXPECT_EQ(all[3].segment, 1u);
}

TEST(Tum, ANewConnectionIsNoNewSegment) {
    const TumSettings settings = worn_by_seven();
    const auto decoder = make_tum(&settings);
    Collector sink;
    decoder->decode(test::bytes_packet(at(1) + "2 5 5"), sink);
    decoder->reset();
    decoder->decode(test::bytes_packet(at(2)), sink);
    const auto all = sink.all<VisualOdometry>();
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[1].position_odometry, (Vec3{1, 2, 3}));
    EXPECT_EQ(all[1].segment, 0u);
}

} // namespace
} // namespace locus::slam
