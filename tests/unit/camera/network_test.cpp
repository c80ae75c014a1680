#include "drivers/camera/detector.h"
#include "drivers/camera/yolo_head.h"
#include "tests/support/temporary_folder.h"

#include "tiny_network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace locus::camera {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class NetworkTest : public testing::Test {
  protected:
    void set(const std::string& name, const OptionValue& value) {
        for (const auto& option : row_->options.rows)
            if (option.name == name) option.set(settings_.get(), value);
    }
    std::unique_ptr<Detector> make() { return row_->make(settings_.get(), {}, error_); }
    void use_tiny(const std::vector<std::int64_t>& shape) {
        test::write_onnx(folder_ / "tiny.onnx", shape);
        set("model", folder_ / "tiny.onnx");
        set("input_px", std::int64_t{32});
        set("least_height_px", 4.);
    }

    locus::test::TemporaryFolder folder_;
    const DetectorRow* row_ = find_detector("network");
    std::shared_ptr<void> settings_ = row_->options.make();
    std::string error_;
};

/// 32 x 32, black; a level of `levels` becomes that number of the tiny network's output, times 32 / 255. Numbers run
/// over the red plane, then the green, then the blue one.
Picture picture_of(const std::vector<std::pair<std::size_t, int>>& levels) {
    constexpr std::size_t plane = 32 * 32;
    Picture picture;
    picture.resize(32, 32, 3);
    std::fill(picture.pixels.begin(), picture.pixels.end(), std::uint8_t{0});
    for (const auto& [at, level] : levels)
        picture.pixels.at(3 * (at % plane) + 2 - at / plane) = static_cast<std::uint8_t>(level);
    return picture;
}

void expect_person(const std::vector<vision::Detection>& found) {
    ASSERT_EQ(found.size(), 1);
    constexpr float step = 32.F / 255; // a grey level
    EXPECT_NEAR(found[0].box.left_px, (128 - 20) * step, 0.01);
    EXPECT_NEAR(found[0].box.top_px, (120 - 50) * step, 0.01);
    EXPECT_NEAR(found[0].box.width_px, 40 * step, 0.01);
    EXPECT_NEAR(found[0].box.height_px, 100 * step, 0.01);
    EXPECT_NEAR(found[0].score, 1, 0.02);
}

TEST_F(NetworkTest, ReadsAHeadOfV5) {
    use_tiny({1, 512, 6});
    const auto detector = make();
    ASSERT_TRUE(detector) << error_;
    expect_person(detector->detect(picture_of({{6, 128}, {7, 120}, {8, 40}, {9, 100}, {10, 8}, {11, 8}})));
    EXPECT_TRUE(detector->detect(picture_of({{6, 128}, {7, 120}, {8, 40}, {9, 100}, {10, 8}})).empty())
        << "of no class";
}

TEST_F(NetworkTest, ReadsAHeadOfV8) {
    use_tiny({1, 6, 512});
    const auto detector = make();
    ASSERT_TRUE(detector) << error_;
    const std::size_t row = 512; // one of x, y, w, h, class 0, class 1; the person stands in column 3
    expect_person(detector->detect(
        picture_of({{3, 128}, {row + 3, 120}, {2 * row + 3, 40}, {3 * row + 3, 100}, {4 * row + 3, 8}})));
}

TEST_F(NetworkTest, ReadsDarknet) {
    test::write_darknet(folder_ / "tiny.cfg", folder_ / "tiny.weights");
    set("model", folder_ / "tiny.weights");
    set("darknet_config", folder_ / "tiny.cfg");
    set("input_px", std::int64_t{32});
    set("least_height_px", 4.);
    set("most_iou", 0.6); // neighbours overlap by a half
    const auto detector = make();
    ASSERT_TRUE(detector) << error_;
    Picture wide; // twice the network's size, and half as high as wide: shrunk to 32 x 16 below 8 rows of grey
    wide.resize(64, 32, 3);
    const auto found = detector->detect(wide);
    ASSERT_EQ(found.size(), 16);
    for (const auto& person : found) EXPECT_NEAR(person.box.width_px, 24, 0.01);
    const auto first = std::min_element(found.begin(), found.end(), [](const auto& a, const auto& b) {
        return a.box.left_px + a.box.top_px < b.box.left_px + b.box.top_px;
    });
    EXPECT_NEAR(first->box.left_px, (4 - 6) * 2, 0.01);
    EXPECT_NEAR(first->box.top_px, (4 - 12 - 8) * 2, 0.01);
}

TEST_F(NetworkTest, SaysWhatIsWrong) {
    set("model", folder_ / "absent.onnx");
    EXPECT_FALSE(make());
    EXPECT_THAT(error_, AllOf(HasSubstr("absent.onnx"), HasSubstr("is not there")));
    std::ofstream(folder_ / "text.onnx") << "no network";
    set("model", folder_ / "text.onnx");
    EXPECT_FALSE(make());
    EXPECT_THAT(error_, HasSubstr("is no network"));
    use_tiny({1, 512, 6});
    set("input_px", std::int64_t{64});
    EXPECT_FALSE(make());
    EXPECT_THAT(error_, AllOf(HasSubstr("64x64"), HasSubstr("set input_px")));
    use_tiny({1, 512, 6});
    set("person_class", std::int64_t{1});
    EXPECT_FALSE(make());
    EXPECT_THAT(error_, AllOf(HasSubstr("1x512x6"), HasSubstr("person_class")));
}

TEST(YoloDecode, LeavesOutWhatIsNoNumber) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    const cv::Mat rows =
        (cv::Mat_<float>(4, 6) << nan, 0, 1, 1, 1, 1, 0, 0, infinite, 1, 1, 1, 0, 0, 1, 1, 1, nan, 0, 0, -1, 1, 1, 1);
    std::vector<vision::Detection> people;
    EXPECT_EQ(decode(rows, {}, {32, 32}, people), "");
    EXPECT_TRUE(people.empty());
}

} // namespace
} // namespace locus::camera
