// When a SLAM begins a new segment, and when its poses were taken.
#include "tests/unit/drivers/slam/tum_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace locus::slam {
namespace {

using test::Collector;

using std::chrono::milliseconds;

std::vector<std::uint32_t> segments(const std::string& text) {
    std::vector<std::uint32_t> all;
    for (const auto& odometry : tum_decoded(text).all<VisualOdometry>()) all.push_back(odometry.segment);
    return all;
}
using Segmented = std::vector<std::uint32_t>;

TEST(TumSegments, ASlamSaysWhatIsANewSegment) {
    EXPECT_EQ(segments(at(1) + at(2) + "# lost\n" + at(3) + at(4)), (Segmented{0, 0, 1, 1}));
    EXPECT_EQ(segments("# lost\n" + at(1) + "#lost\n# lost \n" + at(2)), (Segmented{0, 1})) << "lost once";
    EXPECT_EQ(segments("# segment 4\n" + at(1) + "# segment 4\n" + at(2) + "#segment 9 of 12\n" + at(3)),
              (Segmented{0, 0, 1}));
    EXPECT_EQ(segments(at(1) + "# segment 0\n" + at(2)), (Segmented{0, 1})) << "what had no name was another map";
    EXPECT_EQ(segments(at(9) + "# lost\n" + at(1) + at(2)), (Segmented{0, 1, 1})) << "whatever the stamps then are";
}

/// The first pose of it is passed over: it could have been a stray.
TEST(TumSegments, StampsTellANewSegmentAsWell) {
    EXPECT_EQ(segments(at(10) + at(11) + at(2) + at(3) + at(4)), (Segmented{0, 0, 1, 1})) << "started again";
    EXPECT_EQ(segments(at(10) + at(11) + at(16.1) + at(16.2)), (Segmented{0, 0, 1})) << "silent for 5.1 s";
    EXPECT_EQ(segments(at(10) + at(11) + at(15.9) + at(16)), (Segmented{0, 0, 0, 0})) << "silent for 4.9 s";
    EXPECT_EQ(segments(at(10) + at(10) + at(11)), (Segmented{0, 0, 0})) << "said twice";
}

TEST(TumSegments, AStrayStampEndsNoSegment) {
    for (const double stray : {1.0, 10.5, 14.0, 99.0}) {
        const std::string text = at(10) + at(11) + at(stray) + at(12) + at(13);
        const auto all = segments(text);
        EXPECT_EQ(std::ranges::count(all, 0u), std::ssize(all)) << stray;
        EXPECT_GE(all.size(), 4u) << stray;
    }
    EXPECT_EQ(tum_decoded(at(10) + at(99) + at(11)).refusals, std::vector<Refusal>{Refusal::out_of_range});
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

TEST(TumStamps, OfTheDeviceHaveNoJitterOfTheWay) {
    EXPECT_LT(worst_jitter_s("device"), 0.002);
    EXPECT_GT(worst_jitter_s("arrival"), 0.1);
}

TEST(TumStamps, ByArrivalLookAtNoOthers) {
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

TEST(TumSegments, ANewConnectionIsNoNewSegment) {
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
