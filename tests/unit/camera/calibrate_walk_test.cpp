// `locus calibrate camera walk` from images: two drawn people walk before a drawn wall, the tag is one's.
#include "config/camera_calibration.h"
#include "tests/unit/fusion/vision/simulated_walk.h"
#include "tests/unit/tools/fake_daemon.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <fstream>

namespace locus::camera_test {
namespace {

using testing::HasSubstr;
using vision_test::looking_down;

const cv::Size size_px(480, 270);
const vision::Lens lens = vision::PinholeLens{{300, 300}, {240, 135}, {-0.1, 0.01, 0, 0, 0, 0}, {0, 0}};
constexpr const char* lens_yaml =
    "{model: pinhole, width_px: 480, height_px: 270, fx_px: 300, fy_px: 300, cx_px: 239.5, "
    "cy_px: 134.5, k1: -0.1, k2: 0.01}";
constexpr double offset_s = 0.46, frame_s = 0.1, first_frame_s = 2000;

/// A body of three parts that stands there, 1.75 m high.
void draw_person(cv::Mat& image, const vision::Camera& camera, const Eigen::Vector2d& at_m, const cv::Scalar& colour) {
    const auto foot = look_at(camera, {at_m.x(), at_m.y(), 0}), head = look_at(camera, {at_m.x(), at_m.y(), 1.75});
    if (!foot || !head) return;
    const double high_px = foot->pixel_px.y() - head->pixel_px.y();
    const auto box = [&](double from, double to, double width, const cv::Scalar& with) {
        const Eigen::Vector2d top = head->pixel_px + from * (foot->pixel_px - head->pixel_px),
                              low = head->pixel_px + to * (foot->pixel_px - head->pixel_px);
        cv::rectangle(image, cv::Point2d(top.x() - width * high_px / 2, top.y()),
                      cv::Point2d(low.x() + width * high_px / 2, low.y()), with, cv::FILLED);
    };
    box(0, 0.15, 0.12, {120, 150, 190});
    box(0.15, 0.55, 0.3, colour);
    box(0.55, 1, 0.24, 0.4 * colour);
}

class CalibrateWalk : public testing::Test {
  protected:
    /// Images, ten a second, and the poses of the first person.
    void film(int frames) const {
        const auto camera = looking_down(lens, 4, 0.45);
        cv::Mat scene(size_px, CV_8UC3);
        cv::theRNG().state = 3;
        cv::randn(scene, cv::Scalar::all(130), cv::Scalar::all(25));
        cv::GaussianBlur(scene, scene, {}, 2);
        std::mt19937 random(11);
        vision_test::Stroll tagged(random, false), other(random, false);
        std::ofstream poses(folder_ / "walk.tum");
        for (int i = 0; i < frames; ++i) {
            cv::Mat image = scene.clone(), noise(size_px, CV_8UC3);
            const Eigen::Vector2d one_m = tagged.step(frame_s), other_m = other.step(frame_s);
            poses << fmt::format("{:.6f} {:.4f} {:.4f} 1.2 0 0 0 1\n", first_frame_s + i * frame_s + offset_s,
                                 one_m.x(), one_m.y());
            const bool is_nearer = one_m.y() < other_m.y();
            draw_person(image, camera, is_nearer ? other_m : one_m,
                        is_nearer ? cv::Scalar(60, 60, 200) : cv::Scalar(200, 60, 40));
            draw_person(image, camera, is_nearer ? one_m : other_m,
                        is_nearer ? cv::Scalar(200, 60, 40) : cv::Scalar(60, 60, 200));
            cv::randn(noise, 0, 3);
            image += noise;
            cv::imwrite(folder_ / fmt::format("frame-{:04}.bmp", i), image);
        }
    }
    CommandResult walk(std::vector<std::string> more) const {
        more.insert(more.begin(),
                    {"calibrate", "camera", "walk", "--poses", folder_ / "walk.tum", "--frames", folder_.path()});
        return run_locus({add_calibrate}, std::move(more));
    }
    std::string file(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return folder_ / name;
    }
    double floor_error_m(const std::string& path) const {
        std::vector<ConfigProblem> problems;
        const auto read = config::load_camera(path, problems);
        if (!read) return 1e3;
        const vision::FloorView truth = looking_down(lens, 4, 0.45);
        double most_m = 0;
        for (const Eigen::Vector2d& at_m :
             std::vector<Eigen::Vector2d>{{-1.5, 6}, {1.5, 6}, {0, 9}, {-2, 12}, {2, 12}}) {
            const auto there =
                vision::foot_on_floor(read->view, {*pixel_of_floor(truth, at_m), Eigen::Matrix2d::Identity()});
            most_m = std::max(most_m, there ? (there->position_site_m - at_m).norm() : 1e3);
        }
        return most_m;
    }
    const test::TemporaryFolder& folder() const { return folder_; }

  private:
    test::TemporaryFolder folder_;
};

TEST_F(CalibrateWalk, ImagesAndPosesGiveViewAndClock) {
    film(500);
    const auto out = folder() / "hall.yaml";
    const auto start = fmt::format("{}", first_frame_s);
    const auto plain = walk({"--start", start, "--sigma-m", "0.1", "--out", out, "--json"});
    ASSERT_EQ(plain.exit_code, exit_yes) << plain.err;
    std::printf("%s\n", plain.out.c_str());
    const auto report = nlohmann::json::parse(plain.out);
    EXPECT_NEAR(report["offset_s"], offset_s, 3 * report["offset_sigma_s"].get<double>());
    EXPECT_LT(report["offset_sigma_s"], 0.05);
    std::printf("largest floor error %.3f m\n", floor_error_m(out));
    EXPECT_LT(floor_error_m(out), 0.4);
    const auto lens_path = file("lens.yaml", lens_yaml);
    const auto known = walk({"--camera", lens_path, "--sigma-m", "0.1", "--out", out}); // nobody knows when it began
    ASSERT_EQ(known.exit_code, exit_yes) << known.err;
    std::printf("%s\n", known.out.c_str());
    EXPECT_THAT(known.out, HasSubstr("the camera hangs at"));
    std::printf("largest floor error %.3f m\n", floor_error_m(out));
    EXPECT_LT(floor_error_m(out), 0.3);
}

TEST_F(CalibrateWalk, WhatIsWrongIsSaid) {
    file("walk.tum", "1 0 0 0\n2 1 0 0\n");
    EXPECT_THAT(walk({}).err, HasSubstr("holds no image"));
    film(20);
    const auto late = walk({"--start", "5000"});
    EXPECT_EQ(late.exit_code, exit_no);
    EXPECT_THAT(late.err, HasSubstr("is --start right"));
    const auto wide =
        file("wide.yaml", "{width_px: 640, height_px: 480, fx_px: 300, fy_px: 300, cx_px: 319, cy_px: 239}");
    EXPECT_THAT(walk({"--camera", wide}).err, HasSubstr("another part of it is shown"));
    EXPECT_THAT(walk({"--detector", "eyes"}).err,
                HasSubstr("no detector is called eyes; there are motion, hog, hog_motion, network"));
    EXPECT_THAT(walk({"--detector-settings", file("bad.yaml", "{history_frame: 3}")}).err, HasSubstr("history_frame"));
    EXPECT_THAT(walk({"--detector", "network"}).err, HasSubstr("is no network that OpenCV can read"));
    file("walk.tum", "");
    EXPECT_THAT(walk({}).err, HasSubstr("holds no pose"));
}

} // namespace
} // namespace locus::camera_test
