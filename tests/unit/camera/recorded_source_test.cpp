#include "drivers/camera/recorded_source.h"

#include "tests/support/temporary_folder.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace locus::camera {
namespace {

using locus::test::TemporaryFolder;
using testing::HasSubstr;

cv::Mat grey_picture(int level) { return {32, 48, CV_8UC3, cv::Scalar::all(level)}; }

std::vector<int> levels(FrameSource& source) {
    std::vector<int> seen;
    Frame frame;
    for (auto status = FrameStatus::frame; status != FrameStatus::ended && seen.size() < 20;) {
        status = source.next(frame, std::chrono::milliseconds{1});
        if (status == FrameStatus::frame) seen.push_back(frame.picture.pixels.front());
    }
    return seen;
}

TEST(RecordedFolder, GivesImagesInOrderOfTheirNames) {
    const TemporaryFolder folder;
    for (const int i : {2, 0, 1}) cv::imwrite(folder / ("frame-" + std::to_string(i) + ".png"), grey_picture(50 * i));
    std::ofstream(folder / "notes.txt") << "no image";
    const auto source = make_recorded_source({.path = folder.path(), .speed = 0}, timestamp_from_s(7));
    ASSERT_TRUE(source->open()) << source->last_error();
    Frame frame;
    ASSERT_EQ(source->next(frame, Duration{0}), FrameStatus::frame);
    EXPECT_EQ(frame.captured, timestamp_from_s(7));
    ASSERT_EQ(source->next(frame, Duration{0}), FrameStatus::frame);
    EXPECT_EQ(frame.picture.pixels.front(), 50);
    EXPECT_EQ(frame.captured, timestamp_from_s(7.1)) << "ten a second";
    EXPECT_EQ(frame.sequence, 1);
    EXPECT_EQ(levels(*source), (std::vector<int>{100}));
}

TEST(RecordedFolder, ADamagedImageIsOneFrameLess) {
    const TemporaryFolder folder;
    cv::imwrite(folder / "0.png", grey_picture(10));
    cv::imwrite(folder / "1.png", grey_picture(20));
    cv::imwrite(folder / "2.png", grey_picture(30));
    std::filesystem::resize_file(folder / "1.png", 40);
    const auto source = make_recorded_source({.path = folder.path(), .speed = 0});
    ASSERT_TRUE(source->open());
    EXPECT_EQ(levels(*source), (std::vector<int>{10, 30}));
    EXPECT_EQ(source->damaged(), 1);
}

TEST(RecordedFolder, StartsAgain) {
    const TemporaryFolder folder;
    cv::imwrite(folder / "0.png", grey_picture(10));
    const auto source = make_recorded_source({.path = folder.path(), .speed = 0, .loop = true}, timestamp_from_s(0));
    ASSERT_TRUE(source->open());
    Frame frame;
    for (int i = 0; i < 3; ++i) ASSERT_EQ(source->next(frame, Duration{0}), FrameStatus::frame);
    EXPECT_EQ(frame.captured, timestamp_from_s(0.2)) << "time goes on";
}

TEST(RecordedVideo, HasItsOwnRate) {
    const TemporaryFolder folder;
    const std::string path = folder / "video.avi";
    {
        cv::VideoWriter writer(path, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25, {48, 32});
        for (const int level : {0, 100, 200}) writer.write(grey_picture(level));
    }
    const auto source = make_recorded_source({.path = path, .speed = 0}, timestamp_from_s(0));
    ASSERT_TRUE(source->open()) << source->last_error();
    Frame frame;
    for (int i = 0; i < 3; ++i) ASSERT_EQ(source->next(frame, Duration{0}), FrameStatus::frame);
    EXPECT_EQ(frame.captured, timestamp_from_s(0.08));
    EXPECT_NEAR(frame.picture.pixels.front(), 200, 4);
    EXPECT_EQ(source->next(frame, Duration{0}), FrameStatus::ended);
}

TEST(RecordedVideo, WaitsForItsTime) {
    const TemporaryFolder folder;
    for (const int i : {0, 1}) cv::imwrite(folder / (std::to_string(i) + ".png"), grey_picture(i));
    const auto source = make_recorded_source({.path = folder.path(), .rate_hz = 0.002});
    ASSERT_TRUE(source->open());
    Frame frame;
    EXPECT_EQ(source->next(frame, Duration{0}), FrameStatus::frame);
    EXPECT_EQ(source->next(frame, std::chrono::milliseconds{1}), FrameStatus::nothing) << "due in eight minutes";
}

TEST(RecordedVideo, SaysWhatIsWrong) {
    const TemporaryFolder folder;
    std::ofstream(folder / "text.avi") << "no video";
    const auto absent = make_recorded_source({.path = folder / "absent.avi"});
    EXPECT_FALSE(absent->open());
    EXPECT_THAT(absent->last_error(), HasSubstr("is not there"));
    const auto text = make_recorded_source({.path = folder / "text.avi"});
    EXPECT_FALSE(text->open());
    EXPECT_THAT(text->last_error(), HasSubstr("no video"));
    std::filesystem::create_directory(folder / "empty");
    const auto empty = make_recorded_source({.path = folder / "empty"});
    EXPECT_FALSE(empty->open());
    EXPECT_THAT(empty->last_error(), HasSubstr("holds no image"));
}

} // namespace
} // namespace locus::camera
