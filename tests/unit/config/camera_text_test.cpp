// Calibrations written and read again: the same view, the same lens.
#include "config/camera_text.h"

#include "tests/unit/fusion/vision/cameras.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace locus::config {
namespace {

using vision_test::looking_down;

std::optional<Eigen::Vector2d> floor_of(const vision::FloorView& view, const Eigen::Vector2d& pixel_px) {
    const auto point = vision::foot_on_floor(view, {pixel_px, Eigen::Matrix2d::Identity()});
    return point ? std::optional<Eigen::Vector2d>(point->position_site_m) : std::nullopt;
}

void expect_same_floor(const vision::FloorView& one, const vision::FloorView& other) {
    for (const Eigen::Vector2d& pixel_px :
         std::vector<Eigen::Vector2d>{{640, 700}, {100, 500}, {1200, 650}, {700, 400}}) {
        const auto a_m = floor_of(one, pixel_px), b_m = floor_of(other, pixel_px);
        ASSERT_EQ(a_m.has_value(), b_m.has_value());
        if (!a_m || !b_m) continue;
        EXPECT_LT((*a_m - *b_m).norm(), 1e-9 * (1 + a_m->norm()));
    }
}

TEST(CameraText, AnyViewIsReadBackAsItWas) {
    for (const auto& lens : vision_test::lenses()) {
        const CameraCalibration made{looking_down(lens), {1280, 720}};
        const std::string text = camera_yaml(made, {"made by a test"});
        if (std::holds_alternative<vision::TsaiLens>(lens)) {
            EXPECT_EQ(text, "");
            continue;
        }
        Problems problems("cam");
        const auto read = parse_camera(text, problems);
        ASSERT_TRUE(read) << text;
        EXPECT_THAT(text, testing::HasSubstr("# made by a test\n"));
        EXPECT_EQ(read->image_px, made.image_px);
        expect_same_floor(read->view, made.view);
    }
}

TEST(CameraText, AHomographyToo) {
    Eigen::Matrix3d floor_from_pixel;
    floor_from_pixel << 0.004, 0.001, -3, 0.0002, -0.006, 6, 0.00001, 0.002, -0.3;
    const CameraCalibration made{vision::floor_homography(floor_from_pixel, {640, 720}), {1280, 720}};
    Problems problems("cam");
    const auto read = parse_camera(camera_yaml(made), problems);
    ASSERT_TRUE(read) << camera_yaml(made);
    expect_same_floor(read->view, made.view);
}

TEST(CameraText, ALensAloneIsReadBackAndIsNoCamera) {
    const LensCalibration made{vision_test::lenses()[3], {1280, 720}};
    Problems problems("cam");
    const auto read = parse_lens(lens_yaml(made), problems);
    ASSERT_TRUE(read) << lens_yaml(made);
    const auto& lens = std::get<vision::FisheyeLens>(read->lens);
    EXPECT_EQ(lens.radial, std::get<vision::FisheyeLens>(made.lens).radial);
    EXPECT_EQ(lens.centre_px, std::get<vision::FisheyeLens>(made.lens).centre_px);
    EXPECT_TRUE(problems.empty());
    EXPECT_FALSE(parse_camera(lens_yaml(made), problems));
    EXPECT_THAT(to_string(problems.take().at(0)), testing::HasSubstr("missing: rotation_vector_rad"));
}

TEST(CameraText, WhatHasNoLensIsRefused) {
    const auto refused = [](const std::string& text) {
        Problems problems("cam");
        EXPECT_FALSE(parse_lens(text, problems));
        const auto found = problems.take();
        return found.empty() ? "" : to_string(found[0]);
    };
    EXPECT_THAT(refused("<Camera/>"), testing::HasSubstr("as `locus calibrate camera chessboard` writes it"));
    EXPECT_THAT(refused("{model: homography, width_px: 9, height_px: 9}"), testing::HasSubstr("nothing of the lens"));
    EXPECT_THAT(refused("{width_px: 9, height_px: 9}"), testing::HasSubstr("missing: fx_px"));
}

} // namespace
} // namespace locus::config
