// A device of the kernel, where there is one: tests/hil runs these with vivid, whose first input is a webcam that makes
// its pictures itself.
#include "drivers/camera/v4l2_source.h"

#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace locus::camera {
namespace {

class V4l2Rig : public testing::Test {
  protected:
    void SetUp() override {
        const char* device = std::getenv("LOCUS_CAMERA");
        if (!device) GTEST_SKIP() << "no LOCUS_CAMERA";
        settings_.path = device;
    }
    V4l2Settings settings_{.path = {}, .width_px = 640, .height_px = 360};
};

class V4l2RigFormat : public V4l2Rig, public testing::WithParamInterface<const char*> {};

TEST_P(V4l2RigFormat, FramesComeInOrder) {
    settings_.pixel_format = GetParam();
    const auto source = make_v4l2_source(settings_);
    ASSERT_TRUE(source->open()) << source->last_error();
    Frame frame;
    Timestamp last;
    std::uint64_t last_sequence = 0;
    int frames = 0;
    for (int tries = 0; frames < 10 && tries < 300; ++tries) {
        const auto status = source->next(frame, std::chrono::milliseconds{100});
        ASSERT_NE(status, FrameStatus::lost) << source->last_error();
        if (status != FrameStatus::frame) continue;
        ++frames;
        EXPECT_GT(frame.captured, last);
        EXPECT_GT(frame.sequence, last_sequence);
        EXPECT_EQ(frame.picture.width_px, 640);
        last = frame.captured;
        last_sequence = frame.sequence;
    }
    EXPECT_EQ(frames, 10);
    EXPECT_EQ(source->damaged(), 0);
    EXPECT_EQ(source->trouble(), "");
    EXPECT_EQ(last_sequence, 10 + source->dropped()) << "every frame is given or counted";
}
INSTANTIATE_TEST_SUITE_P(Formats, V4l2RigFormat, testing::Values("any", "yuyv", "nv12", "grey"));

TEST_F(V4l2Rig, AnotherSizeIsAskedForAnew) {
    const auto first = make_v4l2_source(settings_);
    ASSERT_TRUE(first->open()) << first->last_error();
    first->close();
    settings_.width_px = 1280;
    settings_.height_px = 720;
    const auto second = make_v4l2_source(settings_);
    ASSERT_TRUE(second->open()) << second->last_error();
    Frame frame;
    auto status = FrameStatus::nothing;
    for (int tries = 0; status == FrameStatus::nothing && tries < 100; ++tries)
        status = second->next(frame, std::chrono::milliseconds{100});
    ASSERT_EQ(status, FrameStatus::frame) << second->last_error();
    EXPECT_EQ(frame.picture.width_px, 1280);
}

TEST_F(V4l2Rig, ASizeThatIsNotOfferedIsRefused) {
    settings_.width_px = 642;
    const auto source = make_v4l2_source(settings_);
    ASSERT_FALSE(source->open());
    EXPECT_THAT(source->last_error(), testing::HasSubstr("it offers"));
}

TEST_F(V4l2Rig, TwoCannotHaveIt) {
    const auto first = make_v4l2_source(settings_);
    ASSERT_TRUE(first->open()) << first->last_error();
    const auto second = make_v4l2_source(settings_);
    ASSERT_FALSE(second->open());
    EXPECT_THAT(second->last_error(), testing::HasSubstr("in use"));
}

} // namespace
} // namespace locus::camera
