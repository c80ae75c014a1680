// Who keeps the radio map: what is taught comes into use and onto the disk, wrong names are taken back, older versions
// stay, and nothing on the disk keeps the daemon from starting.
#include "config/radio_map.h"
#include "config/radio_map_versions.h"
#include "daemon/radio/map_keeper.h"
#include "fusion/estimators/radio_particles.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace locus {
namespace {

namespace fs = std::filesystem;

/// Twelve points two metres apart, one beacon.
radio::RadioMap corridor_map() {
    radio::RadioMap map{"corridor", "2026-11-01", "test", {}};
    for (int i = 0; i < 12; ++i)
        map.points.push_back({{2.0 * i, i % 2 ? 0.0 : 1.0, 1.2}, {{address(100), -50.0 - 2 * i, 2, 10}}});
    return map;
}

/// A daemon's fusion loop without a thread, its settings, and a folder.
class MapKeepers : public testing::Test {
  protected:
    MapKeepers() { read(); }

    /// The settings as a start of the daemon reads them.
    void read() {
        RadioParticlesSettings radio;
        radio.calibrated_map = path_;
        radio.calibrate_every_s = 60;
        radio.radio_map = std::make_shared<const radio::RadioMap>(corridor_map());
        radio.grid = std::make_shared<radio::GridInUse>();
        config::load_taught_map(radio);
        settings_ = {};
        settings_.fusion.estimator = "radio_particles";
        settings_.estimators.push_back({&radio_particles_row, std::make_shared<RadioParticlesSettings>(radio)});
        auto plan = std::make_unique<FusionPlan>();
        plan->engine = std::make_unique<Engine>(settings_);
        loop_ = std::make_unique<FusionLoop>(std::move(plan), *output_, ticked_);
    }
    const RadioParticlesSettings& radio() const {
        return *static_cast<const RadioParticlesSettings*>(settings_.estimators[0].settings.get());
    }
    std::unique_ptr<MapKeeper> keeper() { return MapKeeper::make(settings_, output_->lessons, *loop_); }

    /// Two hundred times that a beacon is 10 dB stronger at the first point than the survey says.
    void teach(std::uint64_t course) {
        for (int i = 0; i < 200; ++i) output_->lessons.push({course, false, {0, 1}, {address(100), -40}});
    }
    void cycle() { loop_->cycle(timestamp_from_s(++ticks_)); }
    double first_point_dbm() const {
        std::vector<ConfigProblem> problems;
        const auto map = config::load_radio_map(path_, problems);
        return map.has_value() ? map.value().points[0].heard[0].mean_dbm : 0;
    }
    double in_use_dbm() const { return static_cast<double>(radio().grid->grid().at(0, 0, 1).mean_dbm); }

    test::TemporaryFolder folder_;
    std::string path_ = folder_ / "live.yaml";
    EngineSettings settings_;
    std::unique_ptr<FusionOutput> output_ = std::make_unique<FusionOutput>();
    Wake ticked_;
    std::unique_ptr<FusionLoop> loop_;
    double ticks_ = 0;
};

TEST_F(MapKeepers, AreNoneWhereNoMapIsToChange) {
    EXPECT_EQ(MapKeeper::make({}, output_->lessons, *loop_), nullptr);
    EXPECT_NE(keeper(), nullptr);
}

TEST_F(MapKeepers, BringWhatWasTaughtIntoUseAndOntoTheDisk) {
    const auto mine = keeper();
    const double before_dbm = in_use_dbm();
    teach(1);
    mine->work(timestamp_from_s(30), "2026-11-02");
    EXPECT_FALSE(fs::exists(path_)) << "not every time";
    mine->work(timestamp_from_s(60), "2026-11-02");
    EXPECT_NEAR(first_point_dbm(), -40, 0.3);
    EXPECT_EQ(in_use_dbm(), before_dbm) << "only the fusion thread changes what it reads";
    cycle();
    EXPECT_GT(in_use_dbm(), before_dbm + 3);
}

TEST_F(MapKeepers, TakeAWrongNameBack) {
    const auto mine = keeper();
    teach(1);
    mine->work(timestamp_from_s(60), "2026-11-02");
    cycle();
    output_->lessons.push({1, true, {}, {}});
    mine->work(timestamp_from_s(120), "2026-11-02");
    EXPECT_NEAR(first_point_dbm(), -50, 0.1);
}

TEST_F(MapKeepers, GoOnFromWhereTheyWereStopped) {
    auto mine = keeper();
    teach(1);
    mine.reset(); // the daemon stops
    EXPECT_NEAR(first_point_dbm(), -40, 0.3);
    read();
    EXPECT_TRUE(radio().calibration_note.empty());
    EXPECT_NEAR(radio().radio_map->points[0].heard[0].mean_dbm, -40, 0.3);
    EXPECT_EQ(radio().surveyed_map->points[0].heard[0].mean_dbm, -50);
    EXPECT_GT(in_use_dbm(), -47);
    mine = keeper();
    mine.reset();
    EXPECT_NEAR(first_point_dbm(), -40, 0.3) << "nothing new was taught";
}

TEST_F(MapKeepers, KeepAVersionOfEachDayBeforeButNotForEver) {
    const auto mine = keeper();
    for (int day = 10; day < 20; ++day) {
        teach(1);
        mine->work(timestamp_from_s(60.0 * day), "2026-11-" + std::to_string(day));
        cycle();
    }
    EXPECT_TRUE(fs::exists(path_ + ".2026-11-18"));
    EXPECT_TRUE(fs::exists(path_ + ".2026-11-12"));
    EXPECT_FALSE(fs::exists(path_ + ".2026-11-11"));
    EXPECT_FALSE(fs::exists(path_ + ".2026-11-19")) << "today's is the file itself";
}

TEST_F(MapKeepers, StartWithTheSurveyWhereTheFileIsNoMapOfIt) {
    for (const std::string text : {"points: [", "site: elsewhere\npoints:\n"
                                                "  - {position_site_m: [0, 0, 0], heard: [[1, -50]]}\n"
                                                "  - {position_site_m: [1, 0, 0], heard: [[1, -50]]}\n"
                                                "  - {position_site_m: [2, 0, 0], heard: [[1, -50]]}\n"}) {
        std::ofstream(path_) << text;
        read();
        EXPECT_FALSE(radio().calibration_note.empty()) << text;
        EXPECT_EQ(radio().radio_map, radio().surveyed_map);
        auto mine = keeper();
        EXPECT_FALSE(fs::exists(path_));
        EXPECT_TRUE(fs::exists(path_ + ".set-aside"));
    }
}

TEST_F(MapKeepers, BringItIntoUseThoughTheDiskTakesNothing) {
    fs::remove_all(folder_.path());
    const auto mine = keeper();
    const double before_dbm = in_use_dbm();
    teach(1);
    mine->work(timestamp_from_s(60), "2026-11-02");
    cycle();
    EXPECT_GT(in_use_dbm(), before_dbm + 3);
}

TEST_F(MapKeepers, WorkInAThreadOfTheirOwn) {
    auto mine = keeper();
    mine->start();
    teach(1);
    mine.reset();
    EXPECT_NEAR(first_point_dbm(), -40, 0.3);
}

} // namespace
} // namespace locus
