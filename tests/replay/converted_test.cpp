// Recordings of others through their converters in tools/convert, the engine with its defaults, and the scoring of
// `locus evaluate`: the very path that docs/accuracy.md tells people to take. Bars are the quick references that came
// with the data where they are met, else what others published of the same recordings.
#include "config/load.h"
#include "tests/replay/data.h"
#include "tests/support/source_folder.h"
#include "tests/support/temporary_folder.h"
#include "tools/evaluate/read.h"
#include "tools/evaluate/statistics.h"
#include "tools/replay/replay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace locus {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();

struct Recording {
    const char* name; ///< of the case
    const char* converter;
    const char* data; ///< folder of the recordings
    const char* run;  ///< and the converter's options
    const char* output;
    const char* truth = ".truth.tum";
    double rmse_3d_m = none;
    double rmse_2d_m = none;
    const char* bar_from = "";
};

std::ostream& operator<<(std::ostream& out, const Recording& recording) { return out << recording.name; }

constexpr const char* quick = "the quick reference that came with the data, made in Python";
constexpr const char* flights = "util_uwb_tdoa";

constexpr Recording recordings[]{
    // Crazyflie, range differences and its inertial sensor; then with its height sensor; then inside cut-out stretches.
    {"Traj2", flights, flights, "0425_tdoa2_traj2 --no-height", "0425_tdoa2_traj2", ".airborne.tum", 0.22, none, quick},
    {"Traj3", flights, flights, "0425_tdoa2_traj3 --no-height", "0425_tdoa2_traj3", ".airborne.tum", 0.22, none, quick},
    {"Test0", flights, flights, "tdoa2_test_log00 --no-height", "tdoa2_test_log00", ".airborne.tum", 0.22, none, quick},
    {"Traj14", flights, flights, "0425_tdoa3_traj14 --no-height", "0425_tdoa3_traj14", ".airborne.tum", 0.31, none,
     quick},
    {"Traj5", flights, flights, "0426_tdoa3_traj5", "0426_tdoa3_traj5", ".airborne.tum", 0.31, none, quick},
    {"Traj2Height", flights, flights, "0425_tdoa2_traj2", "0425_tdoa2_traj2", ".airborne.tum", 0.12, none, quick},
    {"Traj3Height", flights, flights, "0425_tdoa2_traj3", "0425_tdoa2_traj3", ".airborne.tum", 0.12, none, quick},
    {"Test0Height", flights, flights, "tdoa2_test_log00", "tdoa2_test_log00", ".airborne.tum", 0.12, none, quick},
    {"Traj14Height", flights, flights, "0425_tdoa3_traj14", "0425_tdoa3_traj14", ".airborne.tum", 0.18, none, quick},
    {"Traj5Outage1s", flights, flights, "0426_tdoa3_traj5 --outage 5,1,10", "0426_tdoa3_traj5", ".outage.tum", 0.42,
     none, quick},
    {"Traj5Outage2s", flights, flights, "0426_tdoa3_traj5 --outage 5,2,10", "0426_tdoa3_traj5", ".outage.tum", 0.59,
     none, quick},
    {"Test0Outage1s", flights, flights, "tdoa2_test_log00 --no-height --outage 5,1,10", "tdoa2_test_log00",
     ".outage.tum", 0.37, none, quick},
    {"Test0Outage2s", flights, flights, "tdoa2_test_log00 --no-height --outage 5,2,10", "tdoa2_test_log00",
     ".outage.tum", 0.59, none, quick},
    {"Walk1", "isas_walk", "isas_walk", "ISAS-Walk1", "ISAS-Walk1", ".truth.tum", 0.18, none, quick},
    {"Drone1", "iasl_uwb_imu", "iasl_uwb_imu", "scenario1", "scenario1", ".truth.tum", 0.175, none, quick},
    {"Drone2", "iasl_uwb_imu", "iasl_uwb_imu", "scenario2", "scenario2", ".truth.tum", 0.21, none, quick},
    {"YardClear1", "hanyang_uwb_outdoor", "hanyang_uwb_outdoor", "LOS/Trajectory_A/Case_1", "LOS_Trajectory_A_Case_1",
     ".truth.tum", none, 1.038, "published least squares, the better of the two"},
    {"YardClear2", "hanyang_uwb_outdoor", "hanyang_uwb_outdoor", "LOS/Trajectory_A/Case_2", "LOS_Trajectory_A_Case_2",
     ".truth.tum", none, 0.78, quick},
    {"YardBlocked1", "hanyang_uwb_outdoor", "hanyang_uwb_outdoor", "NLOS/Trajectory_A/Case_1",
     "NLOS_Trajectory_A_Case_1", ".truth.tum", none, 0.938, "published error-state filter"},
    {"YardBlocked2", "hanyang_uwb_outdoor", "hanyang_uwb_outdoor", "NLOS/Trajectory_A/Case_2",
     "NLOS_Trajectory_A_Case_2", ".truth.tum", none, 1.234, "published least squares, the better of the two"},
};

void convert(const Recording& recording, const std::filesystem::path& data, const std::string& folder) {
    const std::string command = "python3 '" + test::source_folder() + "/tools/convert/" + recording.converter + "' '" +
                                data.string() + "' " + recording.run + " --out '" + folder + "' > /dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0) << command; // NOLINT(cert-env33-c,concurrency-mt-unsafe): one thread
}

evaluate::Statistics scored(const std::string& stem, const std::string& truth) {
    const auto loaded = load_settings(stem + ".site.yaml");
    if (!loaded.settings) throw std::runtime_error("the converter's settings have problems");
    const auto poses = stem + ".poses.jsonl";
    const auto summary = replay::replay(*loaded.settings, {stem + ".jsonl", {poses}, ""});
    EXPECT_EQ(summary.read.bad_lines, 0u);
    const auto pairs = associate(evaluate::read_truth(truth), evaluate::read_estimate(poses), {}).pairs;
    EXPECT_GT(pairs.size(), 250u);
    return evaluate::statistics(pairs, {});
}

class Converted : public testing::TestWithParam<Recording> {};

TEST_P(Converted, KeepsItsBarWithAnHonestBound) {
    const Recording recording = GetParam();
    const auto data = test::recorded(recording.data);
    if (!data) GTEST_SKIP() << "no " << recording.data << " in LOCUS_DATA or ../shared/data";
    const test::TemporaryFolder folder;
    ASSERT_NO_FATAL_FAILURE(convert(recording, *data, folder.path()));
    const auto stem = folder / recording.output;
    const auto score = scored(stem, stem + recording.truth);
    ASSERT_TRUE(score.horizontal_coverage.has_value());
    const double held = score.horizontal_coverage->share; // NOLINT(bugprone-unchecked-optional-access): the line above
    std::printf("%-24s 3D %.3f horizontal %.3f m, bound held %.1f %%\n", recording.name, score.spatial.rmse_m,
                score.horizontal.rmse_m, 100 * held);
    EXPECT_LE(score.spatial.rmse_m, recording.rmse_3d_m) << recording.bar_from;
    EXPECT_LE(score.horizontal.rmse_m, recording.rmse_2d_m) << recording.bar_from;
    EXPECT_GE(held, 0.95);
}

INSTANTIATE_TEST_SUITE_P(Recordings, Converted, testing::ValuesIn(recordings),
                         [](const auto& one) { return std::string(one.param.name); });

} // namespace
} // namespace locus
