// Detectors on the PETS 2009 S2.L1 video. LOCUS_ALL_FRAMES=1 takes every frame also where HOG is slow (a quarter of an
// hour); LOCUS_MOT=FOLDER writes what was found there, a file a detector, in the format of the MOT challenge.
#include "drivers/camera/detector.h"
#include "drivers/camera/recorded_source.h"
#include "tests/replay/data.h"
#include "tests/replay/detection_score.h"
#include "tests/replay/pets.h"

#include <cstdio>

#include <gtest/gtest.h>

namespace locus::camera {
namespace {

/// One line: frame and id from 1 and -1, box, score, no place (Leal-Taixe et al. 2015, "MOTChallenge 2015",
/// section 3.3).
void write_mot(std::ofstream& file, std::uint64_t frame, const std::vector<vision::Detection>& detections) {
    for (const auto& [box, score, look, reduced] : detections)
        file << frame + 1 << ",-1," << box.left_px << ',' << box.top_px << ',' << box.width_px << ',' << box.height_px
             << ',' << score << ",-1,-1,-1\n";
}

class PetsDetectors : public testing::Test {
  protected:
    void SetUp() override {
        const auto folder = test::recorded("pets2009");
        if (!folder) GTEST_SKIP() << "no recording pets2009";
        people_ = test::annotations("PETS2009-S2L1.xml");
        video_ = make_recorded_source({.path = *folder / "vtest_480x360_795f.avi", .speed = 0}, Timestamp{});
        ASSERT_TRUE(video_->open()) << video_->last_error();
    }

    test::DetectionScore score(const char* name, unsigned every) {
        if (std::getenv("LOCUS_ALL_FRAMES")) every = 1;
        const DetectorRow* row = find_detector(name);
        const auto settings = row->options.make();
        std::string error;
        const auto detector = row->make(settings.get(), {}, error);
        std::ofstream mot;
        if (const char* mot_folder = std::getenv("LOCUS_MOT")) mot.open(std::string(mot_folder) + "/" + name + ".txt");
        test::DetectionScore score;
        for (Frame frame; video_->next(frame, Duration{0}) == FrameStatus::frame;) {
            if (frame.sequence % every != 0) continue;
            const auto found = detector->detect(frame.picture);
            score.add(boxes(frame.sequence), found);
            write_mot(mot, frame.sequence, found);
        }
        std::printf("%s: recall %.3f, precision %.3f\n", name, score.recall(), score.precision());
        return score;
    }

  private:
    /// In pixels of the video.
    std::vector<vision::BoxPx> boxes(std::size_t frame) const {
        std::vector<vision::BoxPx> boxes;
        if (frame >= people_.size()) return boxes;
        for (const auto& [id, box] : people_[frame])
            boxes.push_back({box.left_px / test::pets_scale, box.top_px / test::pets_scale,
                             box.width_px / test::pets_scale, box.height_px / test::pets_scale});
        return boxes;
    }

    std::vector<test::BoxesOfFrame> people_;
    std::unique_ptr<FrameSource> video_;
};

TEST_F(PetsDetectors, MotionFindsWhoWalks) {
    const auto found = score("motion", 1); // measured: 0.68 and 0.84; bars two standard errors of the 70 s below, 0.05
    EXPECT_GT(found.recall(), 0.63);
    EXPECT_GT(found.precision(), 0.79);
}

TEST_F(PetsDetectors, HogIsWhatItsReferenceIs) {
    const auto found =
        score("hog", 30); // issue 5: 0.71 and 0.86; of 160 people two standard errors of a share are 0.07
    EXPECT_GT(found.recall(), 0.71 - 0.07);
    EXPECT_GT(found.precision(), 0.86 - 0.07);
}

TEST_F(PetsDetectors, HogAndMotionBeatTheirReference) {
    if (!std::getenv("LOCUS_ALL_FRAMES")) GTEST_SKIP() << "takes minutes: LOCUS_ALL_FRAMES=1 runs it";
    const auto found = score("hog_motion", 1);
    EXPECT_GT(found.recall(), 0.80); // both: issue 5; measured: 0.85 and 0.93
    EXPECT_GT(found.precision(), 0.82);
}

} // namespace
} // namespace locus::camera
