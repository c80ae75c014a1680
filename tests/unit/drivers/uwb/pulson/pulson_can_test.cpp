// A P440 on CAN: the vendor's own capture (DOC) and our arithmetic (CALC), protocols.md E-4e.
#include "drivers/uwb/pulson/pulson_can.h"

#include "drivers/recording/log_line.h"
#include "drivers/uwb/pulson/messages.h"
#include "tests/unit/drivers/collector.h"
#include "tests/unit/drivers/uwb/pulson/computed_range.h"

#include <gtest/gtest.h>

namespace locus::uwb::pulson {
namespace {

using namespace std::chrono_literals;
using test::Collector;

const std::vector<std::string> status_capture{
    "18EF8001#F0010001",         "10ECFF80#2040000AFF01EF00", "10EBFF80#01F1010001020A00", "10EBFF80#0200020500A30C15",
    "10EBFF80#0308185A00027441", "10EBFF80#040004000000009C", "10EBFF80#053135303731352D", "10EBFF80#0672633239000000",
    "10EBFF80#0700000000000000", "10EBFF80#0800000000000000", "10EBFF80#0900000000000000", "10EBFF80#0A00FFFFFFFFFFFF"};

const std::vector<std::string> range_frames{
    "10ECFF80#20340008FF01EF00", "10EBFF80#0102010007000000", "10EBFF80#0265000000140000",
    "10EBFF80#031472000014B400", "10EBFF80#0400147800150096", "10EBFF80#050019FF88002801",
    "10EBFF80#06000008000800D2", "10EBFF80#0710680000023B00", "10EBFF80#0801E240FFFFFFFF"};

Collector decode(const std::vector<std::string>& frames, int can_address = 0x80) {
    const PulsonSettings settings{.tag = address(18), .can_address = can_address};
    const auto decoder = make_can(&settings);
    Collector sink;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        std::string error;
        const std::string stamp = "(1700000000." + std::to_string(100000 + i * 50000) + ") can0 ";
        decoder->decode(from_log_line(stamp + frames[i], error).value().packet(), sink);
    }
    return sink;
}

TEST(PulsonCan, TheVendorsStatusCapture) {
    const Collector sink = decode(status_capture);
    EXPECT_EQ(sink.frames, 1);
    EXPECT_TRUE(sink.items.empty() && sink.refusals.empty());
}

TEST(PulsonCan, ARangeInNineFrames) {
    const Collector sink = decode(range_frames);
    ASSERT_EQ(sink.items.size(), 1u);
    EXPECT_TRUE(sink.refusals.empty());
    const Range range = sink.all<Range>()[0];
    EXPECT_EQ(range.anchor, address(101));
    EXPECT_EQ(range.tag, address(18));
    EXPECT_DOUBLE_EQ(range.range_m, 5.234);
    EXPECT_FLOAT_EQ(range.sigma_m, 0.021f);
    EXPECT_EQ(range.line_of_sight, LineOfSight::clear);
    EXPECT_EQ(sink.items[0].time.time_since_epoch(), 1700000000s + 100ms) << "when it was announced";
}

TEST(PulsonCan, OtherRadiosOfTheBusAreNotThisOne) {
    const Collector sink = decode(range_frames, 0x81);
    EXPECT_TRUE(sink.frames == 0 && sink.items.empty() && sink.refusals.empty());
}

TEST(PulsonCan, ALostFrameIsARefusal) {
    auto damaged = range_frames;
    damaged.erase(damaged.begin() + 4);
    damaged.insert(damaged.end(), range_frames.begin(), range_frames.end());
    const Collector sink = decode(damaged);
    EXPECT_EQ(sink.items.size(), 1u);
    EXPECT_EQ(sink.refusals, std::vector{Refusal::malformed});
}

TEST(PulsonCan, AShortMessageStandsInOneFrame) {
    EXPECT_EQ(decode({"18EF0180#0103000700000000"}).frames, 1);
    EXPECT_EQ(decode({"18EF0180#01030007"}).refusals, std::vector{Refusal::malformed});
    EXPECT_EQ(decode({"18EF0180#12340007"}).refusals, std::vector{Refusal::unknown_type});
    EXPECT_EQ(decode({"18EF0180#"}).refusals, std::vector{Refusal::unknown_type});
}

TEST(PulsonCan, ASilentRadioIsGreetedAsInTheVendorsCapture) {
    const PulsonSettings settings{.tag = address(18)};
    const auto decoder = make_can(&settings);
    const auto greeting = decoder->request(Timestamp{0s});
    ASSERT_TRUE(greeting);
    EXPECT_EQ(to_log_line("can0", *greeting), "(0.000000) can0 " + status_capture[0]);
}

TEST(PulsonCan, FramesAsTheRadioSendsThem) {
    const auto frames = can_frames(encode(computed_range));
    ASSERT_EQ(frames.size(), range_frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i)
        EXPECT_EQ(to_log_line("can0", frames[i].packet(Timestamp{0s})), "(0.000000) can0 " + range_frames[i]);
    const auto confirm = can_frames(encode(Confirm{.message = 7}));
    ASSERT_EQ(confirm.size(), 1u);
    EXPECT_EQ(to_log_line("can0", confirm[0].packet(Timestamp{0s})), "(0.000000) can0 18EF0180#0103000700000000");
}

} // namespace
} // namespace locus::uwb::pulson
