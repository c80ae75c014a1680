// The tracker on our own detections of PETS 2009 S2.L1, with looks: figures are in docs/cameras.md. LOCUS_ALL_FRAMES=1
// runs HOG as well, for some ten minutes.
#include "config/camera_calibration.h"
#include "drivers/camera/detector.h"
#include "drivers/camera/recorded_source.h"
#include "tests/replay/pets_tracking.h"

#include <gtest/gtest.h>

namespace locus::camera {
namespace {

vision::Detection in_annotations(vision::Detection detection) {
    vision::BoxPx& box = detection.box;
    for (float* length : {&box.left_px, &box.top_px, &box.width_px, &box.height_px}) *length *= test::pets_scale;
    return detection;
}

class PetsOwn : public testing::Test {
  protected:
    void SetUp() override {
        const auto folder = test::recorded("pets2009");
        if (!folder) GTEST_SKIP() << "no pets2009 in LOCUS_DATA or ../shared/data";
        people_ = test::annotations("PETS2009-S2L1.xml");
        std::vector<ConfigProblem> problems;
        calibration_ = config::load_camera((*folder / "data/calibration/View_001.xml").string(), problems);
        ASSERT_TRUE(calibration_);
        video_ = make_recorded_source({.path = *folder / "vtest_480x360_795f.avi", .speed = 0}, Timestamp{});
        ASSERT_TRUE(video_->open()) << video_->last_error();
    }

    test::PetsFigures track(const char* name) {
        const DetectorRow* row = find_detector(name);
        const auto settings = row->options.make();
        std::string error;
        const auto detector = row->make(settings.get(), {}, error);
        std::vector<std::vector<vision::Detection>> found(people_.size());
        for (Frame frame; video_->next(frame, Duration{0}) == FrameStatus::frame && frame.sequence < found.size();)
            for (auto& detection : detector->detect(frame.picture))
                found[frame.sequence].push_back(in_annotations(std::move(detection)));
        auto figures = test::tracked({}, people_, found, calibration_->view, true);
        print(name, figures);
        return figures;
    }

  private:
    std::vector<test::BoxesOfFrame> people_;
    std::optional<config::CameraCalibration> calibration_;
    std::unique_ptr<FrameSource> video_;
};

/// Issue 5's aim is MOTA 0.72, IDF1 0.65, 25 switches: missed by motion alone, which finds 71 % of the people.
TEST_F(PetsOwn, MotionAlone) {
    const auto figures = track("motion");
    EXPECT_GE(figures.score.mota(), 0.52);
    EXPECT_GE(figures.score.idf1(), 0.50);
    EXPECT_LE(figures.score.switches, 45U);
}

TEST_F(PetsOwn, HogAndMotionReachTheAim) {
    if (!std::getenv("LOCUS_ALL_FRAMES")) GTEST_SKIP() << "takes minutes: LOCUS_ALL_FRAMES=1 runs it";
    auto figures = track("hog_motion");
    EXPECT_GE(figures.score.mota(), 0.72);
    EXPECT_GE(figures.score.idf1(), 0.65);
    EXPECT_LE(figures.score.switches, 25U);
    EXPECT_LE(figures.foot_m(0.5), 0.30)
        << "the aim is 0.15: its feet are 4 % of the height lower than the annotated ones";
}

} // namespace
} // namespace locus::camera
