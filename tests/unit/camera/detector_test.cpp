#include "drivers/camera/detector.h"
#include "drivers/camera/mat.h"
#include "drivers/camera/person_shape.h"
#include "fusion/vision/box_geometry.h"

#include <opencv2/imgproc.hpp>

#include <gtest/gtest.h>

namespace locus::camera {
namespace {

std::unique_ptr<Detector> detector(std::string_view name, const ExpectedHeight& height) {
    const DetectorRow* row = find_detector(name);
    const auto settings = row->options.make();
    std::string error;
    return row->make(settings.get(), height, error);
}

/// A noisy wall, and before it a figure with its shadow on the floor to its right, where its feet are at x.
Picture scene(int foot_x, cv::RNG& random) {
    Picture picture;
    picture.resize(320, 240, 3);
    cv::Mat image = as_mat(picture);
    image.setTo(cv::Scalar(120, 140, 130));
    if (foot_x >= 0) {
        image(cv::Rect{foot_x + 13, 190, 50, 12}) *= 0.7;
        cv::ellipse(image, cv::RotatedRect({static_cast<float>(foot_x), 160}, {27, 80}, 0), {40, 30, 160}, cv::FILLED);
    }
    cv::Mat noise(image.size(), CV_16SC3);
    random.fill(noise, cv::RNG::NORMAL, 0, 2);
    cv::add(image, noise, image, cv::noArray(), CV_8UC3);
    return picture;
}

TEST(MotionDetector, FindsWhoWalksAndNotTheShadow) {
    const auto motion = detector("motion", [](float, float) { return 80.F; });
    cv::RNG random{2};
    for (int i = 0; i < 30; ++i) EXPECT_TRUE(motion->detect(scene(-1, random)).empty()) << "picture " << i;
    for (int x = 60; x < 200; x += 10) {
        const auto found = motion->detect(scene(x, random));
        ASSERT_EQ(found.size(), 1) << "at " << x;
        EXPECT_GT(vision::iou(found[0].box, standing_box(static_cast<float>(x), 200, 80)), 0.7F) << "at " << x;
        EXPECT_EQ(found[0].appearance.size(), 120);
    }
}

TEST(Detectors, TakePicturesOfAnyKindOneAfterTheOther) {
    for (const auto name : {"motion", "hog", "hog_motion"}) {
        const auto any = detector(name, {});
        for (const auto& [width, height, channels] : {std::array{200, 150, 3}, {320, 240, 1}, {20, 20, 3}, {1, 1, 1}}) {
            Picture picture;
            picture.resize(width, height, channels);
            for (int i = 0; i < 2; ++i) EXPECT_TRUE(any->detect(picture).empty()) << name << ' ' << width;
        }
    }
}

TEST(Detectors, TheirNamesAreUnique) {
    for (const auto& row : detector_table()) EXPECT_EQ(find_detector(row.name)->about, row.about);
    EXPECT_EQ(find_detector("nobody"), nullptr);
}

} // namespace
} // namespace locus::camera
