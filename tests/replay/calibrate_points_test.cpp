// `locus calibrate camera points` with the camera of PETS 2009: marks on its floor, seen through View_001.xml, give it
// back.
#include "config/camera_calibration.h"
#include "config/camera_text.h"
#include "tests/replay/data.h"
#include "tests/unit/tools/fake_daemon.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <random>

namespace locus::test {
namespace {

using testing::HasSubstr;

/// Tsai's xu = xd (1 + kappa r^2) turned round as a series in r^2 (Lagrange's inversion): what a pinhole's k1 k2 k3
/// are.
vision::PinholeLens as_pinhole(const vision::TsaiLens& tsai) {
    const double kappa = tsai.kappa1_per_mm2 * tsai.focal_mm * tsai.focal_mm;
    const Eigen::Vector2d focal_px(tsai.focal_mm / tsai.pitch_mm.x(), tsai.focal_mm / tsai.pitch_mm.y());
    return {focal_px, tsai.centre_px, {-kappa, 3 * kappa * kappa, -12 * kappa * kappa * kappa, 0, 0, 0}, {}};
}

class CalibratePoints : public testing::Test {
  protected:
    void SetUp() override {
        const auto path = recorded("pets2009/data/calibration/View_001.xml");
        if (!path) GTEST_SKIP() << "no pets2009 in LOCUS_DATA or ../shared/data";
        std::vector<ConfigProblem> problems;
        const auto read = config::load_camera(path->string(), problems);
        ASSERT_TRUE(read);
        truth_ = std::get<vision::Camera>(read->view);
        lens_ = file("lens.yaml", config::lens_yaml({as_pinhole(std::get<vision::TsaiLens>(truth_.lens)), {768, 576}}));
    }
    /// Marks all over the picture, with the noise of a click and of a tape; `wrong` is a metre off.
    std::string marks(double sigma_px, double sigma_m, int wrong = -1) const {
        std::mt19937 random(4);
        std::normal_distribution<double> normal;
        std::string text = "x_px,y_px,x_m,y_m,name\n";
        int count = 0;
        for (const Eigen::Vector2d& pixel_px : pixels_px_) {
            const Eigen::Vector2d at_m = floor_of(truth_, pixel_px);
            const double off_m = count == wrong ? 1 : 0;
            text +=
                fmt::format("{:.3f}, {:.3f}, {:.4f}, {:.4f}, mark {}\n", pixel_px.x() - 0.5 + sigma_px * normal(random),
                            pixel_px.y() - 0.5 + sigma_px * normal(random), at_m.x() + sigma_m * normal(random) + off_m,
                            at_m.y() + sigma_m * normal(random), count);
            ++count;
        }
        return file("marks.csv", text);
    }
    std::string file(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return folder_ / name;
    }
    static CommandResult points(std::vector<std::string> words) {
        words.insert(words.begin(), {"calibrate", "camera", "points"});
        return run_locus({add_calibrate}, std::move(words));
    }
    static Eigen::Vector2d floor_of(const vision::FloorView& view, const Eigen::Vector2d& pixel_px) {
        const auto there = vision::foot_on_floor(view, {pixel_px, Eigen::Matrix2d::Identity()});
        return there ? there->position_site_m : Eigen::Vector2d::Constant(1e6);
    }
    vision::FloorView written() const {
        std::vector<ConfigProblem> problems;
        return config::load_camera(out_, problems).value().view;
    }
    /// Largest, over the picture between the marks.
    double floor_error_m() const {
        double most_m = 0;
        for (const Eigen::Vector2d& pixel_px :
             std::vector<Eigen::Vector2d>{{200, 300}, {400, 260}, {500, 400}, {300, 480}})
            most_m = std::max(most_m, (floor_of(written(), pixel_px) - floor_of(truth_, pixel_px)).norm());
        return most_m;
    }

    const vision::Camera& truth() const { return truth_; }
    const std::string& lens() const { return lens_; }
    const std::string& out() const { return out_; }

  private:
    const std::vector<Eigen::Vector2d> pixels_px_{{90, 250},  {380, 200}, {650, 260}, {700, 480},
                                                  {400, 540}, {120, 470}, {390, 360}, {560, 330}};
    TemporaryFolder folder_;
    vision::Camera truth_;
    std::string lens_, out_ = folder_ / "hall.yaml";
};

TEST_F(CalibratePoints, ExactMarksGiveTheCameraBack) {
    const auto result = points({marks(0, 0), "--camera", lens(), "--out", out()});
    ASSERT_EQ(result.exit_code, exit_yes) << result.err;
    const auto view = written();
    const auto& camera = std::get<vision::Camera>(view);
    EXPECT_LT((camera.position_site_m() - truth().position_site_m()).norm(), 0.02) << "marks are written to 0.001 px";
    EXPECT_LT(floor_error_m(), 0.01);
    std::printf("%s\n", result.out.c_str());
}

TEST_F(CalibratePoints, NoisyMarksGiveItAsWellAsTheySay) {
    const auto result = points({marks(1, 0.02), "--camera", lens(), "--sigma-px", "1", "--json", "--out", out()});
    ASSERT_EQ(result.exit_code, exit_yes) << result.err;
    const auto report = nlohmann::json::parse(result.out);
    double most_m = 0;
    for (const auto& point : report["points"]) most_m = std::max(most_m, point["sigma_m"].get<double>());
    std::printf("floor error %.3f m, said %.3f m\n", floor_error_m(), most_m);
    EXPECT_LT(floor_error_m(), 3 * most_m);
    EXPECT_LT(most_m, 0.3);
    EXPECT_FALSE(report["worst_is_wrong"]);
}

TEST_F(CalibratePoints, AHomographyHasTheLensInItsResiduals) {
    const auto result = points({marks(0, 0), "--size", "768x576", "--out", out()});
    ASSERT_EQ(result.exit_code, exit_yes) << result.err;
    std::printf("%s\nfloor error of the homography %.3f m\n", result.out.c_str(), floor_error_m());
    EXPECT_LT(floor_error_m(), 0.5);
    EXPECT_GT(floor_error_m(), 0.02) << "a straight fit cannot follow a bent image";
}

TEST_F(CalibratePoints, TheWrongMarkIsNamed) {
    const auto result = points({marks(1, 0.02, 5), "--camera", lens()});
    EXPECT_EQ(result.exit_code, exit_yes) << result.err;
    EXPECT_THAT(result.out, HasSubstr("mark 5 does not fit the others: check its pixel and its place"));
}

TEST_F(CalibratePoints, WhatIsWrongIsSaid) {
    EXPECT_THAT(points({marks(0, 0)}).err, HasSubstr("how large is the image? Say it with --size 1280x720"));
    EXPECT_THAT(points({marks(0, 0), "--size", "768"}).err, HasSubstr("say it as 1280x720"));
    EXPECT_THAT(points({file("a.csv", "1,2,3,4\n1,2,3\n"), "--camera", lens()}).err,
                HasSubstr("a.csv:2: it is not x_px,y_px"));
    EXPECT_THAT(points({file("a.csv", "1,2,3,nan\n"), "--camera", lens()}).err, HasSubstr("a.csv:1"));
    EXPECT_THAT(points({"/nowhere.csv", "--camera", lens()}).err, HasSubstr("/nowhere.csv"));
    EXPECT_THAT(points({marks(0, 0), "--camera", "/nowhere.yaml"}).err, HasSubstr("/nowhere.yaml"));
    EXPECT_THAT(points({marks(0, 0), "--camera", lens(), "--out", "/nowhere/hall.yaml"}).err,
                HasSubstr("cannot be written"));
    const auto few = points({file("a.csv", "1,2,3,4\n9,2,8,4\n# more to come\n"), "--camera", lens()});
    EXPECT_EQ(few.exit_code, exit_no);
    EXPECT_THAT(few.err, HasSubstr("2 points are too few: at least 4"));
    const auto line = file("a.csv", "100,500,0,1\n200,400,1,2\n300,300,2,3\n400,200,3,4\n500,100,4,5\n");
    EXPECT_THAT(points({line, "--size", "768x576"}).err, HasSubstr("the points lie in one line"));
    const auto swapped = file("a.csv", "100,500,0,0\n600,500,0,5\n500,200,8,4\n200,200,8,1\n");
    EXPECT_THAT(points({swapped, "--size", "768x576"}).err, HasSubstr("only a mirror shows the points like that"));
}

} // namespace
} // namespace locus::test
