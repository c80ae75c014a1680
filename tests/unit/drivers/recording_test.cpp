// A recording in place of a device: which lines, which stamps, when it ends.
#include "drivers/clock.h"
#include "tests/unit/drivers/transport_fixture.h"

#include <gmock/gmock.h>

#include <fstream>

namespace locus {
namespace {

using namespace testing_transport;
using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr std::string_view two_inputs = "(1000.000000) can0 123#AA\n"
                                        "(1000.010000000) hall serial#41\n"
                                        "\n# a comment\nnonsense\n"
                                        "(1000.020000001) hall serial#42\n"
                                        "(1000.030000) can0 124##0BB\n";

class RecordingTest : public testing::Test {
  protected:
    std::unique_ptr<Transport> play(std::string_view text, Values values) {
        std::ofstream{folder / "a.log"} << text;
        values["path"] = folder / "a.log";
        return make_transport("recording", values);
    }

    ReadStatus play_to_end(Transport& transport) {
        ReadStatus status = ReadStatus::ok;
        for (int i = 0; i < 1000 && status == ReadStatus::ok; ++i) status = transport.read(sink, 100ms);
        return status;
    }

    test::TemporaryFolder folder;
    KeepingSink sink;
};

TEST_F(RecordingTest, PlaysOneInputsLinesSpacedAsRecordedFromNow) {
    const auto recording = play(two_inputs, {{"input", "hall"}});
    const Timestamp before = monotonic_now();
    ASSERT_TRUE(recording->open()) << recording->last_error();
    const Timestamp opened = monotonic_now();
    EXPECT_EQ(play_to_end(*recording), ReadStatus::ended);
    EXPECT_EQ(sink.text, "AB");
    const Timestamp first = sink.kept[0].packet.time;
    EXPECT_GE(first, receive_stamp(before) + 10ms) << "the file's first line is the zero, also when another input's";
    EXPECT_LE(first, opened + 10ms);
    EXPECT_EQ(sink.kept[1].packet.time - first, Duration{10'000'001});
    EXPECT_GE(monotonic_now(), sink.kept[1].packet.time) << "not before its time";
}

TEST_F(RecordingTest, PlaysBothWires) {
    const auto recording = play(two_inputs, {{"speed", 0.0}});
    ASSERT_TRUE(recording->open());
    EXPECT_EQ(play_to_end(*recording), ReadStatus::ended);
    ASSERT_EQ(sink.kept.size(), 4u);
    EXPECT_EQ(sink.kept[0].packet.wire, Wire::can);
    EXPECT_EQ(sink.kept[1].packet.wire, Wire::bytes);
    EXPECT_TRUE(sink.kept[3].packet.can_fd);
    EXPECT_THAT(std::string{recording->trouble()}, HasSubstr("line 5"));
}

TEST_F(RecordingTest, SpeedZeroDoesNotWaitAndKeepsTheSpacing) {
    const auto recording = play("(0.0) a serial#41\n(86400.0) a serial#42\n", {{"speed", 0.0}});
    ASSERT_TRUE(recording->open());
    EXPECT_EQ(play_to_end(*recording), ReadStatus::ended);
    EXPECT_EQ(sink.kept[1].packet.time - sink.kept[0].packet.time, 86400s);
}

TEST_F(RecordingTest, TwiceAsFast) {
    const auto recording = play("(0.0) a serial#41\n(0.04) a serial#42\n", {{"speed", 2.0}});
    ASSERT_TRUE(recording->open());
    EXPECT_EQ(play_to_end(*recording), ReadStatus::ended);
    EXPECT_EQ(sink.kept[1].packet.time - sink.kept[0].packet.time, 20ms);
}

TEST_F(RecordingTest, ALoopStartsAgainLater) {
    const auto recording = play("(5.0) a serial#41\n(5.01) a serial#42\n", {{"loop", true}, {"speed", 0.0}});
    ASSERT_TRUE(recording->open());
    for (int i = 0; i < 5; ++i) EXPECT_EQ(recording->read(sink, 100ms), ReadStatus::ok);
    EXPECT_EQ(sink.text, "ABABA");
    for (std::size_t i = 1; i < sink.kept.size(); ++i) {
        EXPECT_GT(sink.kept[i].packet.time, sink.kept[i - 1].packet.time);
    }
}

TEST_F(RecordingTest, ALongPauseIsHeldInPiecesOfTheTimeout) {
    const auto recording = play("(5.0) a serial#41\n(3605.0) a serial#42\n", {});
    ASSERT_TRUE(recording->open());
    for (int i = 0; i < 3; ++i) EXPECT_EQ(recording->read(sink, 1ms), ReadStatus::ok);
    EXPECT_EQ(sink.text, "A");
}

TEST_F(RecordingTest, SaysWhatIsMissing) {
    const auto missing = make_transport("recording", {{"path", "/nowhere/a.log"}});
    EXPECT_FALSE(missing->open());
    EXPECT_THAT(std::string{missing->last_error()}, HasSubstr("no such file"));
    const auto other = play(two_inputs, {{"input", "gate"}});
    EXPECT_FALSE(other->open());
    EXPECT_THAT(std::string{other->last_error()}, HasSubstr("no line of input 'gate'"));
}

} // namespace
} // namespace locus
