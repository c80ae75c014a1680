// `locus calibrate camera chessboard` with boards drawn through a known lens.
#include "config/camera_calibration.h"
#include "tests/unit/camera/board_pictures.h"
#include "tests/unit/tools/fake_daemon.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <fstream>

namespace locus::camera_test {
namespace {

using testing::HasSubstr;

const cv::Size image_px(640, 480);
const vision::PinholeLens pinhole{{520, 515}, {331.5, 236.5}, {-0.28, 0.09, 0, 0, 0, 0}, {8e-4, -6e-4}};
const vision::FisheyeLens fisheye{{230, 231}, {324.5, 243.5}, {-0.015, 0.006, -0.003, 0.0004}};

/// All over the image, near and far, tilted to all sides.
std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> places(double reach) {
    std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> out;
    for (const double x : {-1., 0., 1.})
        for (const double y : {-1., 0., 1.}) {
            const double z_m = 0.5 + 0.06 * x + 0.04 * y;
            out.push_back({{0.5 * y + 0.1, -0.5 * x - 0.2, 0.1 * x}, {reach * x, 0.7 * reach * y, z_m}});
        }
    out.push_back({{0.6, 0.1, 0}, {0, 0, 0.36}});
    out.push_back({{0.1, 0.7, 0.2}, {0.02, 0, 0.4}});
    out.push_back({{-0.6, -0.3, 1}, {0, 0.02, 0.42}});
    return out;
}

class CalibrateLens : public testing::Test {
  protected:
    std::string take(const BoardCamera& camera, const Eigen::Vector3d& turn, const Eigen::Vector3d& middle_m) {
        cv::imwrite(folder_ / ("board-" + std::to_string(10 + count_++) + ".png"), camera.picture(turn, middle_m));
        return folder_ / ("board-" + std::to_string(9 + count_) + ".png");
    }
    void take_all(const vision::Lens& lens, double reach) {
        const BoardCamera camera(lens, image_px);
        for (const auto& [turn, middle_m] : places(reach)) take(camera, turn, middle_m);
    }
    static CommandResult chessboard(std::vector<std::string> words) {
        words.insert(words.begin(), {"calibrate", "camera", "chessboard"});
        return run_locus({add_calibrate}, std::move(words));
    }
    CommandResult all_of_folder(std::vector<std::string> more = {}) const {
        more.insert(more.begin(), folder_.path());
        return chessboard(std::move(more));
    }
    static double value(const nlohmann::json& report, const char* name) { return report["parameters"][name]["value"]; }
    static double sigma(const nlohmann::json& report, const char* name) { return report["parameters"][name]["sigma"]; }

    const std::string& folder() const { return folder_.path(); }

  private:
    test::TemporaryFolder folder_;
    int count_ = 0;
};

/// How many of its own sigmas a parameter is off.
#define EXPECT_NEAR_IN_SIGMAS(report, name, truth, most)                                                               \
    EXPECT_LT(std::abs(value(report, name) - (truth)), (most) * sigma(report, name))                                   \
        << name << " " << value(report, name) << " +- " << sigma(report, name) << " for " << (truth)

TEST_F(CalibrateLens, APinholeIsFoundAgain) {
    take_all(pinhole, 0.13);
    const auto out = folder() + "/lens.yaml";
    const auto result = all_of_folder({"--json", "--out", out});
    ASSERT_EQ(result.exit_code, exit_yes) << result.err;
    const auto report = nlohmann::json::parse(result.out);
    std::printf("%s\n", report.dump(1).c_str());
    EXPECT_GE(report["boards"], 10);
    EXPECT_LT(report["reprojection_error_px"], 0.2);
    EXPECT_NEAR_IN_SIGMAS(report, "fx_px", 520, 5);
    EXPECT_NEAR_IN_SIGMAS(report, "fy_px", 515, 5);
    EXPECT_NEAR_IN_SIGMAS(report, "cx_px", 331, 5);
    EXPECT_NEAR_IN_SIGMAS(report, "cy_px", 236, 5);
    EXPECT_NEAR_IN_SIGMAS(report, "k1", -0.28, 5);
    EXPECT_LT(sigma(report, "fx_px"), 1);
    std::vector<ConfigProblem> problems;
    const auto lens = config::load_lens(out, problems);
    ASSERT_TRUE(lens) << to_string(problems.at(0));
    for (const Eigen::Vector2d& pixel_px : std::vector<Eigen::Vector2d>{{60, 60}, {600, 420}, {320, 240}}) {
        const auto back = vision::project(lens->lens, *vision::unproject(pinhole, pixel_px));
        ASSERT_TRUE(back);
        EXPECT_LT((back->pixel_px - pixel_px).norm(), 0.5);
    }
}

TEST_F(CalibrateLens, AFisheyeIsFoundAgain) {
    take_all(fisheye, 0.2);
    const auto result = all_of_folder({"--fisheye", "--json"});
    ASSERT_EQ(result.exit_code, exit_yes) << result.err;
    const auto report = nlohmann::json::parse(result.out);
    std::printf("%s\n", report.dump(1).c_str());
    EXPECT_NEAR_IN_SIGMAS(report, "fx_px", 230, 5);
    EXPECT_NEAR_IN_SIGMAS(report, "fy_px", 231, 5);
    EXPECT_NEAR_IN_SIGMAS(report, "cx_px", 324, 5);
    EXPECT_NEAR_IN_SIGMAS(report, "k1", -0.015, 5);
}

TEST_F(CalibrateLens, WhatIsWrongIsSaid) {
    const BoardCamera camera(pinhole, image_px);
    const auto one = take(camera, {0.3, 0, 0}, {0, 0, 0.5});
    cv::imwrite(folder() + "/nothing.png", cv::Mat(image_px, CV_8UC3, cv::Scalar::all(90)));
    const auto few = all_of_folder();
    EXPECT_EQ(few.exit_code, exit_no);
    EXPECT_THAT(few.err, HasSubstr("was found in 1 of 2 images, and 5 are needed"));
    EXPECT_THAT(chessboard({one, "--columns", "10"}).err, HasSubstr("10 x 6 inner corners was found in 0 of 1"));
    EXPECT_THAT(chessboard({folder() + "/none.png"}).err, HasSubstr("none.png' is not there"));
    std::ofstream(folder() + "/text.txt") << "no image";
    EXPECT_EQ(all_of_folder().exit_code, exit_usage);
    EXPECT_THAT(all_of_folder().err, HasSubstr("text.txt' is no image"));
    cv::imwrite(folder() + "/small.png", cv::Mat(100, 100, CV_8UC3));
    EXPECT_THAT(chessboard({one, folder() + "/small.png"}).err,
                HasSubstr("100 x 100 px and the images before it 640 x 480"));
    EXPECT_THAT(chessboard({one, "--rows", "1"}).err, HasSubstr("--rows"));
    EXPECT_THAT(chessboard({}).err, HasSubstr("IMAGES"));
}

TEST_F(CalibrateLens, BoardsThatNeverTiltAreRefused) {
    const BoardCamera camera(pinhole, image_px);
    for (const double x : {-0.05, 0., 0.05})
        for (const double z : {0.45, 0.6}) take(camera, {0.01 * x, 0.02, 0.3 * x}, {x, 0, z});
    const auto result = all_of_folder();
    EXPECT_EQ(result.exit_code, exit_no) << result.out;
    EXPECT_THAT(result.err, HasSubstr("the boards never tilt enough"));
    EXPECT_THAT(result.err, HasSubstr("20 to 45 degrees"));
}

TEST_F(CalibrateLens, ImagesWithoutABoardAreNamed) {
    take_all(pinhole, 0.13);
    cv::imwrite(folder() + "/nothing.png", cv::Mat(image_px, CV_8UC3, cv::Scalar::all(90)));
    const auto result = all_of_folder();
    EXPECT_EQ(result.exit_code, exit_yes) << result.err;
    EXPECT_THAT(result.out, HasSubstr("no board found: " + folder() + "/nothing.png"));
    EXPECT_THAT(result.out, HasSubstr("model: pinhole\nwidth_px: 640\nheight_px: 480\n"));
}

} // namespace
} // namespace locus::camera_test
