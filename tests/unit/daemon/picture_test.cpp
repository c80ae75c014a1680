#include "daemon/socket/picture.h"

#include "daemon/socket/diagnose.h"

#include <gtest/gtest.h>

namespace locus {
namespace {

PoseItem pose_item(Generation generation, std::uint32_t reset_count, Missing missing = Missing::nothing) {
    PoseItem item;
    item.generation = generation;
    item.pose.target = address(1);
    item.pose.estimate.reset_count = reset_count;
    item.pose.estimate.missing = missing;
    return item;
}

SourceItem source_item(Exclusion reason) {
    SourceItem item{1, 0, 1, {}};
    item.status.source = address(5);
    item.status.last_verdict.reason = reason;
    return item;
}

TEST(Picture, ResetCountNeverGoesBackWhenTheEngineIsMadeAnew) {
    Picture picture;
    EXPECT_EQ(picture.take(pose_item(1, 3)).reset_count(), 3u);
    EXPECT_EQ(picture.take(pose_item(2, 0)).reset_count(), 4u);
    EXPECT_EQ(picture.take(pose_item(2, 1)).reset_count(), 5u);
    EXPECT_EQ(picture.take(pose_item(3, 0)).reset_count(), 6u);
}

TEST(Picture, ANewEngineStartsWithoutTheOldOnesTargetsAndSources) {
    Picture picture;
    picture.take(pose_item(1, 0));
    picture.take(source_item(Exclusion::none));
    TickItem tick;
    tick.generation = 2;
    picture.take(tick);
    EXPECT_TRUE(picture.targets().empty());
    EXPECT_TRUE(picture.sources().empty());
}

TEST(Picture, ASourceThatSaysItIsOutsideItsListIsPassedOver) {
    Picture picture;
    picture.take(SourceItem{1, 5, 5, {}});
    EXPECT_TRUE(picture.sources().empty());
}

TEST(Picture, LatenessIsOfTheLastTenSeconds) {
    Picture picture;
    EXPECT_FALSE(picture.lateness().has_value());
    for (int second = 0; second < 21; ++second) {
        TickItem tick;
        tick.tick = timestamp_from_ns(second * 1'000'000'000LL);
        tick.late = std::chrono::microseconds{second < 10 ? 5000 : second};
        picture.take(tick);
    }
    EXPECT_DOUBLE_EQ(picture.lateness()->max_us, 20);
    EXPECT_DOUBLE_EQ(picture.lateness()->p50_us, 15);
}

TEST(IsDue, GivesTheFirstPoseOfEachInterval) {
    int sent = 0;
    for (int tick = 1; tick <= 1000; ++tick)
        sent += is_due(timestamp_from_s(0.01 * (tick - 1) + 0.005), timestamp_from_s(0.01 * tick + 0.005), 5);
    EXPECT_EQ(sent, 50) << "ten seconds of 100 Hz thinned to 5 Hz";
    EXPECT_TRUE(is_due(timestamp_from_s(1), timestamp_from_s(1), 0));
}

TEST(Diagnose, SaysNothingWhenThereIsAPosition) {
    Picture picture;
    picture.take(pose_item(1, 0));
    EXPECT_TRUE(diagnose(picture, {}).empty());
}

TEST(Diagnose, BeginsWithTheInputThatIsNotThere) {
    Roster roster;
    roster.anchors = 4;
    auto status = std::make_shared<InputStatus>();
    status->state = InputState::waiting;
    status->trouble.set("/dev/ttyACM0: no such device; is it plugged in?");
    roster.inputs.push_back({"hall", "serial", "trek", status});
    Picture picture;
    picture.take(pose_item(1, 0, Missing::measurements));
    const auto sentences = diagnose(picture, roster);
    ASSERT_EQ(sentences.size(), 2u);
    EXPECT_EQ(sentences[0], "input \"hall\" is not open: /dev/ttyACM0: no such device; is it plugged in?");
    EXPECT_EQ(sentences[1], "target 0x1: no measurement of this target has come yet");
}

TEST(Diagnose, TellsSilenceFromBytesThatMeanNothing) {
    Roster roster;
    roster.anchors = 4;
    auto status = std::make_shared<InputStatus>();
    status->state = InputState::open;
    roster.inputs.push_back({"hall", "serial", "trek", status});
    EXPECT_NE(diagnose({}, roster)[0].find("not one byte has come"), std::string::npos);
    status->bytes = 100;
    status->refused[0] = 3;
    EXPECT_NE(diagnose({}, roster)[0].find("wrong device, decoder or speed?"), std::string::npos);
}

TEST(Diagnose, AnEmptyConfigurationHasEveryStepNamed) {
    const auto sentences = diagnose({}, {});
    ASSERT_EQ(sentences.size(), 3u);
    EXPECT_NE(sentences[0].find("no anchors"), std::string::npos);
    EXPECT_NE(sentences[1].find("no input"), std::string::npos);
    EXPECT_NE(sentences[2].find("no target"), std::string::npos);
}

} // namespace
} // namespace locus
