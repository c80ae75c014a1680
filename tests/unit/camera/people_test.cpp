// What detectors are made of: suppression, regions, looks, heights, and people laid over what moves.
#include "drivers/camera/appearance.h"
#include "drivers/camera/cover.h"
#include "drivers/camera/height_grid.h"
#include "drivers/camera/mat.h"
#include "drivers/camera/people_settings.h"
#include "drivers/camera/person_shape.h"
#include "drivers/camera/suppress.h"
#include "fusion/vision/box_geometry.h"
#include "fusion/vision/colours.h"
#include "fusion/vision/look_book.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace locus::camera {
namespace {

float likeness(const vision::Appearance& a, const vision::Appearance& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.F);
}

/// Somebody in a shirt and trousers before grey.
Picture dressed(const cv::Scalar& shirt, const cv::Scalar& trousers, const vision::BoxPx& box) {
    Picture picture;
    picture.resize(200, 200, 3);
    cv::Mat image = as_mat(picture);
    image.setTo(cv::Scalar::all(128));
    const auto block = [&](double from, double to, const cv::Scalar& colour) {
        const cv::Rect2d part{box.left_px, box.top_px + from * box.height_px, box.width_px,
                              (to - from) * box.height_px};
        cv::rectangle(image, cv::Rect(part), colour, cv::FILLED);
    };
    block(0, 0.13, {120, 160, 220});
    block(0.13, 0.47, shirt);
    block(0.47, 1, trousers);
    return picture;
}

TEST(Suppress, KeepsTheSurestOfThoseThatOverlap) {
    const auto kept =
        suppress({{{0, 0, 10, 20}, 0.5F, {}}, {{1, 0, 10, 20}, 0.9F, {}}, {{30, 0, 10, 20}, 0.1F, {}}}, 0.5F);
    ASSERT_EQ(kept.size(), 2);
    EXPECT_EQ(kept[0].score, 0.9F);
    EXPECT_EQ(kept[1].box.left_px, 30);
}

TEST(Region, HasFeetInside) {
    const auto region = Region::parse("0,0.5 1,0.5 1,1 0,1");
    ASSERT_TRUE(region);
    EXPECT_TRUE(region->has_feet_of({40, 10, 20, 60}, 100, 100)) << "the head may be outside";
    EXPECT_FALSE(region->has_feet_of({40, 10, 20, 30}, 100, 100));
    EXPECT_TRUE(Region::parse("")->has_feet_of({0, 0, 1, 1}, 100, 100));
    for (const char* wrong : {"0,0 1,1", "0,0 1,1 2,0", "0;0 1,1 1,0", "a", "0,0 1,1 1", "nan,0 1,1 1,0"})
        EXPECT_FALSE(Region::parse(wrong)) << wrong;
}

TEST(Appearance, IsOfUnitLengthAndTellsClothesApart) {
    const vision::BoxPx here{50, 20, 41, 100}, there{120, 60, 33, 80};
    const auto red = appearance(dressed({0, 0, 200}, {150, 0, 0}, here), here);
    EXPECT_NEAR(likeness(red, red), 1, 1e-5);
    EXPECT_GT(likeness(red, appearance(dressed({0, 0, 200}, {150, 0, 0}, there), there)), 0.95);
    EXPECT_LT(likeness(red, appearance(dressed({0, 200, 0}, {150, 0, 0}, there), there)), 0.8);
    EXPECT_LT(likeness(red, appearance(dressed({150, 0, 0}, {0, 0, 200}, there), there)), 0.6) << "changed clothes";
}

TEST(Appearance, OfNobodyIsEmpty) {
    Picture grey;
    grey.resize(50, 50, 1);
    EXPECT_TRUE(appearance(grey, {10, 10, 10, 20}).empty());
    const Picture colour = dressed({}, {}, {});
    EXPECT_TRUE(appearance(colour, {500, 500, 10, 20}).empty());
    EXPECT_TRUE(appearance(colour, {-50, -50, 10, 20}).empty());
    EXPECT_FALSE(appearance(colour, {150, 150, 100, 100}).empty()) << "half of it is inside";
}

vision::Colours colours_in(const Picture& picture, const vision::BoxPx& box) {
    return vision::colours_of(looks(appearance(picture, box))).value();
}

TEST(Looks, TellClothesApartAndNotFullnessOfColour) {
    const vision::BoxPx here{50, 20, 41, 100};
    const auto worn = [&](const cv::Scalar& shirt, const cv::Scalar& trousers) {
        return colours_in(dressed(shirt, trousers, here), here);
    };
    const auto red = worn({0, 0, 200}, {150, 0, 0});
    EXPECT_LT(vision::bhattacharyya_distance(red, worn({60, 60, 200}, {150, 40, 40})), 0.1) << "in pale light";
    EXPECT_GT(vision::bhattacharyya_distance(red, worn({0, 200, 0}, {150, 0, 0})), 0.5);
    EXPECT_GT(vision::bhattacharyya_distance(red, worn({150, 0, 0}, {0, 0, 200})), 0.9) << "changed clothes";
}

TEST(Looks, OfNoSuchAppearanceAreNotKnown) {
    EXPECT_EQ(looks({}), Looks{});
    EXPECT_EQ(looks(vision::Appearance(128, 0.1F)), Looks{}) << "a network's embedding";
    EXPECT_EQ(looks(vision::Appearance(120, 0)), Looks{});
}

/// A crowd in coats of any colour, with folds, before two cameras; the second has a warmer and darker picture.
class TwoCameras {
  public:
    explicit TwoCameras(unsigned seed) : random_(seed) { cv::theRNG().state = seed; }
    cv::Scalar coat() { return {any(), any(), any()}; }
    vision::Colours seen(const cv::Scalar& shirt, const cv::Scalar& trousers, bool warm) {
        const vision::BoxPx box{50, 20, 41, 100};
        Picture picture = dressed(shirt, trousers, box);
        cv::Mat image = as_mat(picture);
        cv::Mat folds(image.size(), CV_16SC3), sum;
        cv::randn(folds, cv::Scalar::all(0), cv::Scalar::all(20));
        image.convertTo(sum, CV_16SC3);
        sum += folds;
        if (warm) cv::multiply(sum, cv::Scalar(0.6, 0.8, 0.95), sum);
        sum.convertTo(image, CV_8UC3);
        return colours_in(picture, box);
    }

  private:
    double any() { return std::uniform_real_distribution<double>{20, 230}(random_); }
    std::mt19937 random_;
};

/// How many of those seen in one camera only are the most alike to themselves in the other.
struct Found {
    int as_they_are = 0, carried_over = 0, of = 0;
    double off_as_they_are = 0, off_carried_over = 0; ///< sums of distances to themselves
};

void look_for(unsigned seed, Found& found) {
    constexpr std::uint64_t in_both = 60, all = 100;
    TwoCameras cameras(seed);
    vision::LookBook book(2, all);
    std::vector<vision::Colours> first, second;
    for (std::uint64_t i = 0; i < all; ++i) {
        const auto shirt = cameras.coat(), trousers = cameras.coat();
        first.push_back(cameras.seen(shirt, trousers, false));
        second.push_back(cameras.seen(shirt, trousers, true));
        book.learn(0, address(i), first.back(), timestamp_from_s(1));
        if (i < in_both) book.learn(1, address(i), second.back(), timestamp_from_s(2));
    }
    for (std::size_t i = in_both; i < all; ++i) {
        std::vector<double> off, off_carried;
        for (std::size_t k = in_both; k < all; ++k) {
            off.push_back(vision::bhattacharyya_distance(first[k], second[i]));
            off_carried.push_back(vision::bhattacharyya_distance(book.colours(1, address(k)).value(), second[i]));
        }
        const auto least = [&](const std::vector<double>& d) { return std::ranges::min_element(d) - d.begin(); };
        const auto self = static_cast<std::ptrdiff_t>(i - in_both);
        found.as_they_are += least(off) == self;
        found.carried_over += least(off_carried) == self;
        found.off_as_they_are += off[i - in_both];
        found.off_carried_over += off_carried[i - in_both];
        ++found.of;
    }
}

TEST(Looks, AreCarriedFromOneCameraToAnother) {
    Found found;
    for (unsigned seed = 1; seed <= 5; ++seed) look_for(seed, found);
    std::printf("of %d people found again among 40: by looks as they are %d, carried over %d; mean distance %.3f and "
                "%.3f\n",
                found.of, found.as_they_are, found.carried_over, found.off_as_they_are / found.of,
                found.off_carried_over / found.of);
    EXPECT_GT(found.carried_over, found.as_they_are);
    EXPECT_LT(found.off_carried_over, found.off_as_they_are);
}

TEST(HeightMap, LearnsThePlaneAmongOutliers) {
    HeightMap heights{{}};
    std::mt19937 random{1};
    std::uniform_real_distribution<float> share{0, 1};
    std::normal_distribution<float> noise{0, 0.07F};
    for (int i = 0; i < 300; ++i) {
        const float x = 640 * share(random), y = 150 + 300 * share(random);
        const float height = (0.4F * y - 20) * (1 + noise(random));
        const bool is_group = share(random) < 0.2F;
        heights.learn(standing_box(x, y, is_group ? height * 1.8F : height));
    }
    EXPECT_NEAR(heights.at(320, 200).value_or(0), 60, 3);
    EXPECT_NEAR(heights.at(320, 400).value_or(0), 140, 7);
    EXPECT_FALSE(heights.at(320, 60)) << "the horizon is near";
}

TEST(HeightMap, BelievesTheCalibration) {
    HeightMap heights{[](float, float y) { return y < 100 ? std::nanf("") : 50.F; }};
    EXPECT_TRUE(heights.is_known());
    for (int i = 0; i < 100; ++i) heights.learn({0, 0, 50, 200});
    EXPECT_EQ(heights.at(0, 200), 50.F);
    EXPECT_FALSE(heights.at(0, 50));
}

/// A body as background subtraction sees it: less than its box.
void stand(cv::Mat& mask, float x, float y, float height) {
    const cv::Point2f middle{x, y - height / 2};
    cv::ellipse(mask, cv::RotatedRect(middle, {0.33F * height, height}, 0), cv::Scalar(255), cv::FILLED);
}

class CoverTest : public testing::Test {
  protected:
    bool found(float x, float y) const {
        const auto box = standing_box(x, y, 80);
        return std::any_of(people_.begin(), people_.end(),
                           [&](const auto& person) { return vision::iou(person.box, box) > 0.6F; });
    }
    void look(const std::vector<vision::Detection>& known = {}) {
        HeightGrid grid;
        grid.refresh(heights_, mask_.size());
        people_ = cover(mask_, grid.standing(), {}, known);
    }

    HeightMap heights_{[](float, float) { return 80.F; }};
    cv::Mat mask_ = cv::Mat::zeros(240, 320, CV_8UC1);
    std::vector<vision::Detection> people_;
};

TEST_F(CoverTest, NobodyIsNobody) {
    mask_(cv::Rect{10, 10, 12, 12}).setTo(255);
    look();
    EXPECT_TRUE(people_.empty());
}

TEST_F(CoverTest, PartsThoseWhoStandSideBySide) {
    for (const float x : {100.F, 132.F, 164.F}) stand(mask_, x, 200, 80);
    look();
    EXPECT_EQ(people_.size(), 3);
    for (const float x : {100.F, 132.F, 164.F}) EXPECT_TRUE(found(x, 200)) << x;
}

TEST_F(CoverTest, JoinsFragmentsOfOneBody) {
    stand(mask_, 160, 200, 80);
    mask_(cv::Rect{0, 150, 320, 8}).setTo(0); // a belt in the colour of the wall
    look();
    EXPECT_EQ(people_.size(), 1);
    EXPECT_TRUE(found(160, 200));
}

TEST_F(CoverTest, LeavesOutWhoIsKnown) {
    stand(mask_, 100, 200, 80);
    stand(mask_, 200, 200, 80);
    look({{standing_box(100, 200, 80), 1, {}}});
    EXPECT_EQ(people_.size(), 1);
    EXPECT_TRUE(found(200, 200));
}

TEST(Sorting, LeavesPossibleSizesInTheRegionTheSurestFirst) {
    const Sorting sorting{{.least_height_px = 30, .most_height_px = 100, .region = "0,0 0.5,0 0.5,1 0,1"}};
    Picture picture;
    picture.resize(200, 200, 3);
    const auto kept = sorting.sort(picture, {{{20, 20, 20, 50}, 0.2F, {}},
                                             {{20, 90, 20, 60}, 0.8F, {}},
                                             {{20, 20, 10, 20}, 1, {}},
                                             {{20, 20, 60, 150}, 1, {}},
                                             {{150, 20, 20, 50}, 1, {}}});
    ASSERT_EQ(kept.size(), 2);
    EXPECT_EQ(kept[0].score, 0.8F);
    EXPECT_FALSE(kept[0].appearance.empty());
}

} // namespace
} // namespace locus::camera
