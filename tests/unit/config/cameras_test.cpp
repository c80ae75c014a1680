// Section "cameras": what an installer writes, and what she is told when it is wrong.
#include "load_fixture.h"

#include <gtest/gtest.h>

namespace locus {
namespace {

constexpr auto two_cameras = R"(
site: {name: hall}
cameras:
  - name: gate
    source: v4l2
    path: /dev/video0
    width_px: 1280
    height_px: 720
    detector: motion
    calibration: /etc/locusd/gate.yaml
    lost_s: 4
  - {name: film, source: recorded, path: /tmp/film.avi, detector: hog, enabled: false}
vision: {anonymous: true, settle_s: 0.5}
)";

TEST(Cameras, AreRead) {
    const auto loaded = load_settings_text(two_cameras, "f");
    ASSERT_TRUE(loaded.settings.has_value()) << to_string(loaded.problems.at(0));
    const Settings& settings = loaded.settings.value();
    ASSERT_EQ(settings.cameras.size(), 2u);
    EXPECT_EQ(settings.engine.cameras, 2u);
    EXPECT_EQ(settings.cameras[0].name, "gate");
    EXPECT_EQ(settings.cameras[0].source->name, "v4l2");
    EXPECT_EQ(settings.cameras[0].detector->name, "motion");
    EXPECT_EQ(settings.cameras[0].calibration, "/etc/locusd/gate.yaml");
    EXPECT_EQ(settings.cameras[0].tracker.lost_s, 4);
    EXPECT_FALSE(settings.cameras[1].enabled);
    EXPECT_TRUE(settings.engine.vision.anonymous);
    EXPECT_EQ(settings.engine.vision.settle_s, 0.5);
}

std::string first_problem(const std::string& cameras) {
    const auto loaded = load_settings_text("site: {name: hall}\n" + cameras, "f");
    return loaded.problems.empty() ? "" : to_string(loaded.problems.front());
}

TEST(Cameras, ThatCannotBeAreRefusedWithASentence) {
    EXPECT_NE(first_problem("cameras: [{name: a, source: v4l3, path: /dev/video0, detector: motion}]").find("v4l2"),
              std::string::npos);
    EXPECT_NE(first_problem("cameras: [{name: a, source: v4l2, path: /dev/video0, detector: motoin}]").find("motion"),
              std::string::npos);
    EXPECT_NE(first_problem("cameras: [{name: a, source: v4l2, detector: motion}]").find("path"), std::string::npos);
    EXPECT_NE(first_problem("cameras: [{name: a b, source: v4l2, path: /dev/video0, detector: motion}]").find("word"),
              std::string::npos);
    EXPECT_NE(first_problem("cameras: [{name: a, source: v4l2, path: /dev/video0, detector: motion, region: \"1,2\"}]")
                  .find("corners"),
              std::string::npos);
    const std::string one = "{name: a, source: v4l2, path: /dev/video0, detector: motion}";
    EXPECT_NE(first_problem("cameras: [" + one + ", " + one + "]").find("second"), std::string::npos);
}

TEST(Cameras, ThatAreWornTellTheWearersWay) {
    const auto loaded =
        load_settings_text("site: {name: hall}\ncameras: [{name: body, source: v4l2, path: /dev/video0, "
                           "worn_by: 0x10, calibration: /lens.yaml, features: 1500}]",
                           "f");
    ASSERT_TRUE(loaded.settings.has_value()) << to_string(loaded.problems.at(0));
    const CameraInputSettings& camera = loaded.settings.value().cameras.at(0);
    EXPECT_TRUE(camera.is_worn());
    EXPECT_EQ(camera.worn_by, address(16));
    EXPECT_EQ(camera.odometry.features, 1500U);
    EXPECT_EQ(camera.detector, nullptr);
}

TEST(Cameras, ThatAreWornNeedALensAndNoDetector) {
    const std::string worn = "cameras: [{name: a, source: v4l2, path: /dev/video0, worn_by: 16";
    EXPECT_NE(first_problem(worn + "}]").find("calibrate camera chessboard"), std::string::npos);
    EXPECT_NE(first_problem(worn + ", calibration: /l.yaml, detector: motion}]").find("detector"), std::string::npos);
    EXPECT_NE(first_problem(worn + ", calibration: /l.yaml, lost_s: 4}]").find("lost_s"), std::string::npos);
}

TEST(Cameras, AndInputsHaveNamesOfTheirOwn) {
    EXPECT_NE(first_problem("inputs: [{name: a, transport: tcp, host: h, port: 1, decoder: nmea, tag: 5}]\n"
                            "cameras: [{name: a, source: recorded, path: /x.avi, detector: motion}]")
                  .find("both an input and a camera"),
              std::string::npos);
}

} // namespace
} // namespace locus
