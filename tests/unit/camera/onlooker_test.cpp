// What the daemon makes of a camera whose files are wrong: a sentence, and nobody seen.
#include "daemon/camera/onlooker.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace locus {
namespace {

using testing::HasSubstr;

constexpr auto looks_down = "model: homography\nwidth_px: 640\nheight_px: 480\nfloor_x: [0.01, 0, 0]\n"
                            "floor_y: [0, 0.01, 0]\nfloor_w: [0, 0, 1]\n";

CameraInputSettings with_detector(std::string_view name) {
    CameraInputSettings settings;
    settings.name = "gate";
    settings.detector = camera::find_detector(name);
    settings.detector_settings = settings.detector->options.make();
    return settings;
}

camera::Frame frame_of(int width_px, int height_px) {
    camera::Frame frame;
    frame.picture.resize(width_px, height_px, 3);
    frame.captured = timestamp_from_s(1);
    return frame;
}

TEST(Onlooker, NeedsACalibrationOfTheSameShape) {
    const test::TemporaryFolder folder;
    CameraInputSettings settings = with_detector("motion");
    settings.calibration = folder / "gate.yaml";
    std::ofstream(settings.calibration) << looks_down;
    Onlooker onlooker(settings);
    EXPECT_TRUE(onlooker.look(frame_of(640, 360)).empty());
    EXPECT_THAT(onlooker.trouble(), HasSubstr("640x480"));
    EXPECT_THAT(onlooker.trouble(), HasSubstr("640x360"));
    EXPECT_FALSE(onlooker.floor().has_value());
    onlooker.look(frame_of(320, 240)); // tried anew: the camera was set to another size
    EXPECT_EQ(onlooker.trouble(), "");
    ASSERT_TRUE(onlooker.floor().has_value());
    const auto place = vision::foot_on_floor(onlooker.floor().value(), {{100, 200}, Eigen::Matrix2d::Identity()});
    EXPECT_NEAR(place.value().position_site_m.x(), 2, 0.02) << "half as wide, so a pixel is twice as much";
}

TEST(Onlooker, NeedsTheFilesThatItsSettingsName) {
    CameraInputSettings settings = with_detector("motion");
    settings.calibration = "/nowhere/gate.yaml";
    Onlooker blind(settings);
    EXPECT_TRUE(blind.look(frame_of(64, 48)).empty());
    EXPECT_THAT(blind.trouble(), HasSubstr("/nowhere/gate.yaml"));
    settings = with_detector("network");
    for (const OptionRow& row : settings.detector->options.rows)
        if (row.name == "model") row.set(settings.detector_settings.get(), std::string("/nowhere/people.onnx"));
    Onlooker untaught(settings);
    EXPECT_TRUE(untaught.look(frame_of(64, 48)).empty());
    EXPECT_THAT(untaught.trouble(), HasSubstr("/nowhere/people.onnx"));
    EXPECT_TRUE(untaught.feet(address(0)).empty());
}

TEST(Onlooker, WithoutACalibrationSeesButPlacesNobody) {
    Onlooker onlooker(with_detector("motion"));
    onlooker.look(frame_of(64, 48));
    EXPECT_EQ(onlooker.trouble(), "");
    EXPECT_TRUE(onlooker.feet(address(0)).empty());
}

} // namespace
} // namespace locus
