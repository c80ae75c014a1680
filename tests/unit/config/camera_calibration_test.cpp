// Calibration files of cameras: what good ones become, and the sentence that each kind of bad one gets.
#include "config/camera_calibration.h"

#include <gtest/gtest.h>

#include <string>

namespace locus::config {
namespace {

const std::string good_yaml = R"(
model: pinhole
width_px: 1280
height_px: 720
fx_px: 800
fy_px: 800
cx_px: 639.5
cy_px: 359.5
rotation_vector_rad: [3.141592653589793, 0, 0]
translation_m: [0, 0, 4]
)";

const std::string good_xml = R"(<?xml version="1.0"?>
<Camera name="View_001">
 <Geometry width="768" height="576" dpx="5.0e-03" dpy="4.65e-03"/>
 <Intrinsic focal="5.5" kappa1="5.1e-03" cx="324.2" cy="282.6" sx="1.09"/>
 <Extrinsic tx="828.7" ty="-3175.5" tz="35469" rx="2.04" ry="-0.893" rz="-0.43"/>
</Camera>)";

std::string camera_problem(const std::string& text) {
    Problems problems("cam");
    const auto calibration = parse_camera(text, problems);
    EXPECT_EQ(calibration.has_value(), problems.empty());
    const auto found = problems.take();
    return found.empty() ? "" : to_string(found[0]);
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

std::optional<vision::FloorPoint> floor_at(const CameraCalibration& calibration, double x_px, double y_px) {
    return vision::foot_on_floor(calibration.view, {{x_px, y_px}, Eigen::Matrix2d::Identity()});
}

TEST(CameraCalibration, YamlOfACameraThatLooksStraightDown) {
    Problems problems("cam");
    const auto calibration = parse_camera(good_yaml, problems);
    ASSERT_TRUE(calibration) << camera_problem(good_yaml);
    // OpenCV's 639.5 from the middle of the first pixel is 640 from its corner: the middle of the image.
    const auto middle = floor_at(*calibration, 640, 360), right = floor_at(*calibration, 840, 360);
    ASSERT_TRUE(middle && right);
    EXPECT_LT(middle->position_site_m.norm(), 1e-9);
    EXPECT_LT((right->position_site_m - Eigen::Vector2d(1, 0)).norm(), 1e-9); // 4 m x 200 / 800
    const auto half =
        vision::foot_on_floor(view_for(*calibration, {640, 360}), {{420, 180}, Eigen::Matrix2d::Identity()});
    ASSERT_TRUE(half);
    EXPECT_LT((half->position_site_m - Eigen::Vector2d(1, 0)).norm(), 1e-9) << "the same in an image half as large";
}

TEST(CameraCalibration, YamlOfAHomography) {
    Problems problems("cam");
    const auto calibration = parse_camera("{model: homography, width_px: 100, height_px: 100, floor_x: [0.01, 0, 0], "
                                          "floor_y: [0, 0.02, 0], floor_w: [0, 0, 1]}",
                                          problems);
    ASSERT_TRUE(calibration);
    const auto point = floor_at(*calibration, 50.5, 50.5);
    ASSERT_TRUE(point);
    EXPECT_LT((point->position_site_m - Eigen::Vector2d(0.5, 1)).norm(), 1e-12);
}

TEST(CameraCalibration, TsaiXml) {
    Problems problems("cam");
    const auto calibration = parse_camera(good_xml, problems);
    ASSERT_TRUE(calibration) << camera_problem(good_xml);
    EXPECT_EQ(calibration->image_px, Eigen::Vector2d(768, 576));
    const auto& camera = std::get<vision::Camera>(calibration->view);
    EXPECT_NEAR(camera.site_in_camera_m.z(), 35.469, 1e-9);
    // Tsai 1987: of Rz Ry Rx, the last row is (-sin ry, cos ry sin rx, cos ry cos rx).
    EXPECT_NEAR(camera.camera_from_site(2, 0), std::sin(0.893), 1e-12);
    EXPECT_NEAR(camera.camera_from_site(2, 1), std::cos(0.893) * std::sin(2.04), 1e-12);
    EXPECT_NEAR(camera.camera_from_site(2, 2), std::cos(0.893) * std::cos(2.04), 1e-12);
    const auto& lens = std::get<vision::TsaiLens>(camera.lens);
    EXPECT_NEAR(lens.pitch_mm.x(), 5e-3 / 1.09, 1e-12);
    EXPECT_NEAR(lens.centre_px.y(), 283.1, 1e-12);
    EXPECT_TRUE(floor_at(*calibration, 384, 500));
}

TEST(CameraCalibration, EachMistakeHasItsSentence) {
    const std::pair<std::string, std::string> cases[]{
        {changed(good_yaml, "fx_px: 800\n", ""), "cam: missing: fx_px, which the model \"pinhole\" needs"},
        {changed(good_yaml, "fx_px", "f_px"), "f_px"},
        {changed(good_yaml, "fx_px: 800", "fx_px: wide"), "number"},
        {changed(good_yaml, "pinhole", "mirror"), "mirror"},
        {changed(good_yaml, "width_px: 1280\n", ""), "width_px"},
        {changed(good_yaml, "[0, 0, 4]", "[0, 0, -4]"), "4.00 m below the floor"},
        {changed(good_yaml, "translation_m: [0, 0, 4]", ""), "translation_m"},
        {"{model: homography, width_px: 9, height_px: 9, floor_x: [1, 0, 0], floor_y: [2, 0, 0], floor_w: [0, 0, 1]}",
         "depend on each other"},
        {changed(good_xml, "focal=\"5.5\" ", ""), "missing: focal of <Intrinsic>"},
        {changed(good_xml, "\"5.5\"", "\"5,5\""), "cam:4:3: wrong type: focal of <Intrinsic> is \"5,5\""},
        {changed(good_xml, "\"5.5\"", "\"nan\""), "wrong type: focal"},
        {changed(good_xml, "\"5.5\"", "\"0\""), "out of range: focal"},
        {changed(good_xml, "sx=\"1.09\"", "sx=\"0\""), "out of range: sx"},
        {changed(good_xml, "<Geometry", "<Geo"), "missing: <Geometry>"},
        {changed(good_xml, "ty=\"-3175.5\" tz=\"35469\"", "ty=\"-3175.5\" tz=\"-35469\""), "below the floor"},
        {"<Other/>", "missing: <Camera>"},
        {"<Camera", "this is no XML"},
        {"<!DOCTYPE a [<!ENTITY b \"c\">]>", "XML"},
    };
    for (const auto& [text, sentence] : cases) {
        const std::string problem = camera_problem(text);
        EXPECT_NE(problem.find(sentence), std::string::npos) << "for\n" << text << "\nthe problem was: " << problem;
    }
    EXPECT_NE(camera_problem(""), "");
}

TEST(CameraCalibration, DeepAndLongXmlIsSurvived) {
    std::string deep;
    for (int i = 0; i < 300'000; ++i) deep += "<a>";
    EXPECT_NE(camera_problem(deep), "");
    EXPECT_NE(camera_problem("<Camera>" + std::string(2'000'000, ' ')).find("larger"), std::string::npos);
}

TEST(CameraCalibration, AFileThatIsNotThereIsNamed) {
    std::vector<ConfigProblem> problems;
    EXPECT_FALSE(load_camera("/nowhere/camera.yaml", problems));
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_NE(to_string(problems[0]).find("/nowhere/camera.yaml"), std::string::npos);
}

} // namespace
} // namespace locus::config
