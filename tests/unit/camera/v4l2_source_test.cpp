#include "drivers/camera/v4l2_source.h"

#include "fake_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace locus::camera {
namespace {

using test::FakeCamera;
using test::FakeCameraState;
using test::FakeFrame;
using testing::AllOf;
using testing::HasSubstr;

FakeFrame grey_yuyv(std::uint32_t sequence, std::uint8_t luma = 128) {
    FakeFrame frame{.sequence = sequence, .bytes = std::vector<std::uint8_t>(64 * 48 * 2, 128)};
    for (std::size_t i = 0; i < frame.bytes.size(); i += 2) frame.bytes[i] = luma;
    return frame;
}

class V4l2SourceTest : public testing::Test {
  protected:
    std::unique_ptr<FrameSource> source() { return make_v4l2_source(settings_, std::make_unique<FakeCamera>(camera_)); }
    /// The sentence of a source that must not open.
    std::string refusal() {
        const auto refused = source();
        EXPECT_FALSE(refused->open());
        EXPECT_EQ(camera_->mapped, 0);
        return std::string{refused->last_error()};
    }

    std::shared_ptr<FakeCameraState> camera_ = std::make_shared<FakeCameraState>();
    V4l2Settings settings_{.path = "/dev/video7", .width_px = 64, .height_px = 48};
    Frame frame_;
};

TEST_F(V4l2SourceTest, GivesPicturesWithTheDriversStamp) {
    const auto open = source();
    ASSERT_TRUE(open->open()) << open->last_error();
    camera_->frames.push_back(grey_yuyv(0, 235));
    ASSERT_EQ(open->next(frame_, Duration{0}), FrameStatus::frame);
    EXPECT_EQ(frame_.picture.width_px, 64);
    EXPECT_EQ(frame_.picture.height_px, 48);
    EXPECT_EQ(frame_.picture.pixels.front(), 255) << "235 is white in video";
    EXPECT_EQ(to_ns(frame_.captured), 5'000'000'000);
    EXPECT_EQ(open->trouble(), "");
}

TEST_F(V4l2SourceTest, TakesTheExposureByWhichEndOfItIsStamped) {
    settings_.exposure_s = 0.02;
    settings_.delay_s = 0.003;
    const auto open = source();
    ASSERT_TRUE(open->open());
    camera_->frames.push_back(grey_yuyv(0));
    ASSERT_EQ(open->next(frame_, Duration{0}), FrameStatus::frame);
    EXPECT_EQ(to_ns(frame_.captured), 4'987'000'000) << "end, less half the exposure and the delay";
    camera_->frames.push_back(grey_yuyv(1));
    camera_->frames.back().flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
    ASSERT_EQ(open->next(frame_, Duration{0}), FrameStatus::frame);
    EXPECT_EQ(to_ns(frame_.captured), 5'007'000'000) << "start, and half the exposure, less the delay";
}

TEST_F(V4l2SourceTest, SaysThatStampsAreOfAnotherClock) {
    const auto open = source();
    ASSERT_TRUE(open->open());
    camera_->frames.push_back(grey_yuyv(0));
    camera_->frames.back().flags = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN;
    ASSERT_EQ(open->next(frame_, Duration{0}), FrameStatus::frame);
    EXPECT_NE(to_ns(frame_.captured), 5'000'000'000);
    EXPECT_THAT(open->trouble(), HasSubstr("clock"));
}

TEST_F(V4l2SourceTest, CountsWhatTheSequenceSkips) {
    const auto open = source();
    ASSERT_TRUE(open->open());
    for (const std::uint32_t sequence : {4'294'967'294u, 4'294'967'295u, 2u}) { // over the wrap, 0 and 1 lost
        camera_->frames.push_back(grey_yuyv(sequence));
        ASSERT_EQ(open->next(frame_, Duration{0}), FrameStatus::frame);
    }
    EXPECT_EQ(open->dropped(), 2);
    EXPECT_EQ(frame_.sequence, 5);
}

TEST_F(V4l2SourceTest, ADriverThatCountsNothingLosesNothing) {
    const auto open = source();
    ASSERT_TRUE(open->open());
    for (int i = 0; i < 3; ++i) {
        camera_->frames.push_back(grey_yuyv(0));
        ASSERT_EQ(open->next(frame_, Duration{0}), FrameStatus::frame);
    }
    EXPECT_EQ(open->dropped(), 0);
    EXPECT_EQ(frame_.sequence, 3);
}

TEST_F(V4l2SourceTest, GivesTheNewestAndCountsTheOthers) {
    const auto open = source();
    ASSERT_TRUE(open->open());
    for (const std::uint32_t sequence : {0u, 1u, 2u})
        camera_->frames.push_back(grey_yuyv(sequence, static_cast<std::uint8_t>(16 + 50 * sequence)));
    ASSERT_EQ(open->next(frame_, Duration{0}), FrameStatus::frame);
    EXPECT_GT(frame_.picture.pixels.front(), 100) << "the last one's grey";
    EXPECT_EQ(open->dropped(), 2);
    EXPECT_EQ(camera_->queued.size(), 4) << "all buffers are the driver's again";
}

TEST_F(V4l2SourceTest, AShortFrameIsCountedAndARowOfThemIsALoss) {
    const auto open = source();
    ASSERT_TRUE(open->open());
    FrameStatus status = FrameStatus::nothing;
    std::string trouble;
    for (std::uint32_t i = 0; i < 30; ++i) {
        camera_->frames.push_back(grey_yuyv(i));
        camera_->frames.back().bytes.resize(100);
        if (i == 29) trouble = open->trouble();
        status = open->next(frame_, Duration{0});
    }
    EXPECT_EQ(open->damaged(), 30);
    EXPECT_THAT(trouble, AllOf(HasSubstr("damaged"), HasSubstr("100 of 6144 bytes")));
    EXPECT_EQ(status, FrameStatus::lost);
}

TEST_F(V4l2SourceTest, BelievesNoSizeOfTheDriver) {
    const auto open = source();
    ASSERT_TRUE(open->open());
    camera_->frames.push_back(grey_yuyv(0));
    camera_->frames.back().bytes.resize(1'000'000); // more than the buffer holds
    EXPECT_EQ(open->next(frame_, Duration{0}), FrameStatus::frame);
}

TEST_F(V4l2SourceTest, LosesAndComesBack) {
    const auto open = source();
    ASSERT_TRUE(open->open());
    camera_->gone = true;
    ASSERT_EQ(open->next(frame_, Duration{0}), FrameStatus::lost);
    EXPECT_THAT(open->last_error(), AllOf(HasSubstr("/dev/video7"), HasSubstr("unplugged")));
    camera_->gone = false;
    ASSERT_TRUE(open->open());
    camera_->frames.push_back(grey_yuyv(0));
    EXPECT_EQ(open->next(frame_, Duration{0}), FrameStatus::frame);
    EXPECT_EQ(camera_->mapped, 4) << "the first buffers were given back";
}

TEST_F(V4l2SourceTest, AChangeOfSignalIsALoss) {
    const auto open = source();
    ASSERT_TRUE(open->open());
    camera_->event = true;
    ASSERT_EQ(open->next(frame_, Duration{0}), FrameStatus::lost);
    EXPECT_THAT(open->last_error(), HasSubstr("signal changed"));
}

TEST_F(V4l2SourceTest, SilenceIsALoss) {
    settings_.silence_s = 0;
    const auto open = source();
    ASSERT_TRUE(open->open());
    EXPECT_EQ(open->next(frame_, Duration{0}), FrameStatus::lost);
    EXPECT_THAT(open->last_error(), HasSubstr("no frame"));
}

TEST_F(V4l2SourceTest, SaysWhatIsOfferedInsteadOfTheSize) {
    camera_->formats = {{V4L2_PIX_FMT_YUYV, 320, 240, 30}, {V4L2_PIX_FMT_YUYV, 640, 480, 30}};
    EXPECT_THAT(refusal(), AllOf(HasSubstr("64x48"), HasSubstr("320x240, 640x480"), HasSubstr("width_px")));
}

TEST_F(V4l2SourceTest, SaysWhatIsOfferedInsteadOfTheFormat) {
    camera_->formats = {{V4L2_PIX_FMT_H264, 64, 48, 30}};
    EXPECT_THAT(refusal(), AllOf(HasSubstr("H264"), HasSubstr("pixel_format")));
    settings_.pixel_format = "grey";
    camera_->formats = {{V4L2_PIX_FMT_YUYV, 64, 48, 30}};
    EXPECT_THAT(refusal(), AllOf(HasSubstr("grey"), HasSubstr("YUYV")));
}

TEST_F(V4l2SourceTest, TakesTheFormatThatIsFastEnough) {
    settings_.rate_hz = 30;
    camera_->formats = {{V4L2_PIX_FMT_YUYV, 64, 48, 10}, {V4L2_PIX_FMT_MJPEG, 64, 48, 30}};
    const auto open = source();
    ASSERT_TRUE(open->open());
    EXPECT_EQ(camera_->current.fourcc, V4L2_PIX_FMT_MJPEG);
    EXPECT_EQ(open->trouble(), "");
}

TEST_F(V4l2SourceTest, SaysThatNoFormatIsFastEnough) {
    settings_.rate_hz = 60;
    camera_->formats = {{V4L2_PIX_FMT_YUYV, 64, 48, 30}, {V4L2_PIX_FMT_MJPEG, 64, 48, 10}};
    const auto open = source();
    ASSERT_TRUE(open->open());
    EXPECT_EQ(camera_->current.fourcc, V4L2_PIX_FMT_YUYV);
    EXPECT_THAT(open->trouble(), HasSubstr("only 30 frames"));
}

TEST_F(V4l2SourceTest, SaysWhyItCannotOpen) {
    camera_->open_fails = EACCES;
    EXPECT_THAT(refusal(), HasSubstr("no permission"));
    camera_->open_fails = ENOENT;
    EXPECT_THAT(refusal(), HasSubstr("plugged in"));
    camera_->open_fails = 0;
    camera_->fails[VIDIOC_QUERYCAP] = ENOTTY;
    EXPECT_THAT(refusal(), HasSubstr("is no camera"));
    camera_->fails.clear();
    camera_->capabilities = V4L2_CAP_VIDEO_OUTPUT | V4L2_CAP_STREAMING;
    EXPECT_THAT(refusal(), HasSubstr("gives no pictures"));
    camera_->capabilities = V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_STREAMING;
    EXPECT_THAT(refusal(), HasSubstr("several planes"));
    camera_->capabilities = V4L2_CAP_VIDEO_CAPTURE;
    EXPECT_THAT(refusal(), HasSubstr("share its buffers"));
    camera_->capabilities |= V4L2_CAP_STREAMING;
    camera_->fails[VIDIOC_REQBUFS] = EBUSY;
    EXPECT_THAT(refusal(), HasSubstr("in use"));
    camera_->fails = {{VIDIOC_S_FMT, EBUSY}};
    EXPECT_THAT(refusal(), HasSubstr("in use"));
    camera_->fails = {{VIDIOC_STREAMON, ENOSPC}};
    EXPECT_THAT(refusal(), HasSubstr("USB bus"));
}

TEST(V4l2Kernel, AFileIsNoCamera) {
    const auto file = make_v4l2_source({.path = "/dev/null"});
    ASSERT_FALSE(file->open());
    EXPECT_THAT(file->last_error(), HasSubstr("is no camera"));
    const auto absent = make_v4l2_source({.path = "/dev/video-not-there"});
    ASSERT_FALSE(absent->open());
    EXPECT_THAT(absent->last_error(), HasSubstr("is not there"));
}

} // namespace
} // namespace locus::camera
