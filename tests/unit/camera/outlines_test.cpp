// What the outline detectors are made of.
#include "drivers/camera/hog.h"
#include "drivers/camera/patches.h"
#include "drivers/camera/regions.h"
#include "drivers/camera/suppress.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

#include <gtest/gtest.h>

namespace locus::camera {
namespace {

bool is_same(const vision::Detection& a, const vision::Detection& b) {
    return a.box.left_px == b.box.left_px && a.box.top_px == b.box.top_px && a.box.height_px == b.box.height_px &&
           std::abs(a.score - b.score) < 1e-4F;
}

cv::Mat clutter() {
    cv::RNG random{3};
    cv::Mat picture(120, 160, CV_8UC3);
    random.fill(picture, cv::RNG::UNIFORM, 0, 255);
    cv::GaussianBlur(picture, picture, {9, 9}, 0);
    return picture;
}

/// Around the middle of the picture and of one size.
bool is_in_the_middle(std::size_t level, const vision::BoxPx& person) {
    return level < 9 && std::abs(person.left_px - 70) < 15 && std::abs(person.top_px - 40) < 15;
}

TEST(Hog, LooksWhereItIsToldAndFindsThereWhatItFindsAnyway) {
    const Hog hog({.least_margin = -5});
    const auto everywhere = hog.find(clutter(), [](std::size_t, const auto&) { return true; });
    std::size_t wanted = 0;
    const auto middle = hog.find(clutter(), [&](std::size_t level, const auto& person) {
        wanted += is_in_the_middle(level, person);
        return is_in_the_middle(level, person);
    });
    ASSERT_GT(middle.size(), 5U);
    EXPECT_LT(middle.size(), everywhere.size() / 2);
    for (const auto& one : middle)
        EXPECT_TRUE(std::ranges::any_of(everywhere, [&](const auto& other) { return is_same(one, other); }));
    EXPECT_GT(wanted, 20U);
    EXPECT_TRUE(hog.find(clutter(), [](std::size_t, const auto&) { return false; }).empty());
}

TEST(Patches, HoldAllMarksAndPartWhatIsFar) {
    cv::Mat1b marked(cv::Size{80, 60}, 0);
    EXPECT_TRUE(patches_of(marked).empty());
    for (const cv::Point at : {cv::Point{0, 0}, {3, 2}, {79, 59}, {40, 30}, {46, 30}}) marked(at) = 255;
    const auto patches = patches_of(marked);
    EXPECT_EQ(patches.size(), 3U) << "marks closer than a window share one";
    cv::Mat1b held(marked.size(), 0);
    for (const cv::Rect& patch : patches) held(patch) = 255;
    EXPECT_EQ(cv::countNonZero(marked & ~held), 0);
    EXPECT_LT(cv::countNonZero(held), 100);
}

TEST(Suppress, ByVoteIsTheWeightedMeanOfWhatLiesCloselyOnTheSurest) {
    const std::vector<vision::Detection> found{
        {{0, 0, 10, 20}, 1, {}}, {{1, 0, 10, 20}, 3, {}}, {{4, 0, 10, 20}, 2, {}}, {{30, 0, 10, 20}, -1, {}}};
    const auto kept = suppress_by_vote(found, 0.3F);
    ASSERT_EQ(kept.size(), 2U);
    EXPECT_EQ(kept[0].score, 3);
    EXPECT_FLOAT_EQ(kept[0].box.left_px, 0.75F) << "the third is another's, or none of this one";
    EXPECT_EQ(kept[1].box.left_px, 30) << "who stands alone stays where he is, whatever his score";
}

class LowestMoving : public testing::Test {
  protected:
    cv::Mat1b foreground{cv::Size{100, 200}, 0};
    const vision::BoxPx box{30, 50, 40, 100}; ///< ends at 150
};

TEST_F(LowestMoving, IsTheSilhouettesEnd) {
    foreground(cv::Rect{40, 60, 20, 84}) = 255;
    EXPECT_EQ(lowest_moving_px(foreground, box), 144.F);
}

TEST_F(LowestMoving, IsNotKnownWhereItGoesOnOrNothingMoves) {
    EXPECT_EQ(lowest_moving_px(foreground, box), std::nullopt);
    foreground(cv::Rect{40, 60, 20, 130}) = 255;
    EXPECT_EQ(lowest_moving_px(foreground, box), std::nullopt) << "somebody stands nearer";
    EXPECT_EQ(lowest_moving_px(foreground, {30, 150, 40, 100}), std::nullopt) << "its feet are outside";
    EXPECT_EQ(lowest_moving_px(foreground, {300, 150, 40, 100}), std::nullopt);
}

} // namespace
} // namespace locus::camera
