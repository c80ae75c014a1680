// Receivers with and without an inertial sensor through gnss_ins: from the files of the receiver over `locus import`,
// a converter and the engine to the scoring of `locus evaluate` (docs/accuracy.md).
#include "config/load.h"
#include "tests/replay/data.h"
#include "tests/support/source_folder.h"
#include "tests/support/temporary_folder.h"
#include "tools/evaluate/read.h"
#include "tools/evaluate/statistics.h"
#include "tools/import/import.h"
#include "tools/replay/replay.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <limits>

namespace locus {
namespace {

constexpr double no_bar = std::numeric_limits<double>::infinity();

struct GnssDrive {
    const char* name;
    const char* folder;
    std::vector<const char*> files; ///< for `locus import`
    const char* converter;          ///< with its options
    bool less_mean;                 ///< the truth stands metres beside every solution
    double median_m, most_m;        ///< horizontal, 50 and 95 %, of all poses
    double held;                    ///< least share of poses within their published 95 % bound
    const char* bar_from;
};

std::ostream& operator<<(std::ostream& out, const GnssDrive& drive) { return out << drive.name; }

constexpr const char* walk_folder = "gnss_imu_walk_drive/walk_0827";
constexpr const char* span_folder = "google_gnss/NmeaUtils/example";
constexpr const char* canyon_folder = "graphgnss_hk_tst/gps_solution_TST";
constexpr const char* span_log = "MTV.Local1.ublox-F9K.20200206-181434.nmea";
const std::vector<const char*> canyon_files{"COM3_190428_124409.obs", "hksc1180.19n", "hksc1180.19b"};

constexpr const char* by_points = "the single points of the same observations";
constexpr const char* by_fixes = "a tenth, and half of the 95 %, above the fixes themselves at their own times";
constexpr const char* by_plain = "a plain single point with GPS alone; 95 % that of ours";

const GnssDrive gnss_drives[]{
    {"WalkTight", walk_folder, {"gnss_1730.ubx"}, "gnss_imu_walk --raw", true, 0.64, 2.43, 0, by_points},
    {"WalkLoose",
     walk_folder,
     {"gnss_1730.ubx"},
     "gnss_imu_walk --coupling loose --raw",
     true,
     0.64,
     2.43,
     0,
     by_points},
    {"WalkTightWithoutSensor",
     walk_folder,
     {"gnss_1730.ubx"},
     "gnss_imu_walk --no-imu --raw",
     true,
     0.64,
     2.43,
     0,
     by_points},
    {"FixesWithoutSensor", span_folder, {span_log}, "google_gnss --fixes", false, 0.54, 1.25, 0.95, by_fixes},
    {"CanyonTight", canyon_folder, canyon_files, "graphgnss_hk --raw", false, 6.53, 62, 0, by_points},
    {"CanyonTightGpsAlone", canyon_folder, canyon_files, "graphgnss_hk --gps --raw", false, 12.3, 112, 0, by_plain},
};

/// The stem of what the converter wrote.
std::string convert_drive(const GnssDrive& drive, const std::filesystem::path& data, const std::string& folder) {
    importing::Request request{{}, folder + "/imported.jsonl", address(7)};
    for (const char* file : drive.files) request.files.push_back((data / file).string());
    importing::import_files(request);
    const std::string command = "python3 '" + test::source_folder() + "/tools/convert/'" + drive.converter + " '" +
                                request.output + "' '" + data.string() + "' --name drive --out '" + folder +
                                "' > /dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0) << command; // NOLINT(cert-env33-c,concurrency-mt-unsafe): one thread
    return folder + "/drive";
}

evaluate::Statistics score_drive(const std::string& stem) {
    const auto loaded = load_settings(stem + ".site.yaml");
    if (!loaded.settings) throw std::runtime_error("the converter's settings have problems");
    const auto poses = stem + ".poses.jsonl";
    const auto summary = replay::replay(*loaded.settings, {stem + ".jsonl", {poses}, ""});
    EXPECT_EQ(summary.read.bad_lines, 0U);
    evaluate::Selection every;
    every.max_gap_s = 1.5; // truths of one a second
    const auto pairs =
        associate(evaluate::read_truth(stem + ".truth.tum"), evaluate::read_estimate(poses), every).pairs;
    EXPECT_GT(pairs.size(), 10'000U);
    return evaluate::statistics(pairs, {});
}

class GnssDrives : public testing::TestWithParam<GnssDrive> {};

TEST_P(GnssDrives, KeepsItsBar) {
    const GnssDrive& drive = GetParam();
    const auto data = test::recorded(drive.folder);
    if (!data) GTEST_SKIP() << "no " << drive.folder << " in LOCUS_DATA or ../shared/data";
    const test::TemporaryFolder folder;
    const auto score = score_drive(convert_drive(drive, *data, folder.path()));
    const auto& error = drive.less_mean ? score.horizontal_less_bias : score.horizontal;
    ASSERT_TRUE(score.horizontal_coverage.has_value());
    const double held = score.horizontal_coverage->share; // NOLINT(bugprone-unchecked-optional-access): the line above
    std::printf("%-24s horizontal median %.2f m, 95 %% %.2f m, most %.2f m, bound held %.1f %%\n", drive.name,
                error.median_m, error.p95_m, error.max_m, 100 * held);
    EXPECT_LE(error.median_m, drive.median_m) << drive.bar_from;
    EXPECT_LE(error.p95_m, drive.most_m) << drive.bar_from;
    EXPECT_GE(held, drive.held);
}

INSTANTIATE_TEST_SUITE_P(Recordings, GnssDrives, testing::ValuesIn(gnss_drives),
                         [](const auto& one) { return std::string(one.param.name); });

// ---- with the carrier's change and without it

const GnssDrive carrier_drives[]{
    {"Walk", walk_folder, {"gnss_1730.ubx"}, "gnss_imu_walk --settings 'use_carrier: %' --raw", true, 0, 0, 0, ""},
    {"WalkWithoutSensor",
     walk_folder,
     {"gnss_1730.ubx"},
     "gnss_imu_walk --no-imu --settings 'use_carrier: %' --raw",
     true,
     0,
     0,
     0,
     ""},
    {"Canyon", canyon_folder, canyon_files, "graphgnss_hk --settings 'use_carrier: %' --raw", false, 0, 0, 0, ""},
    {"CanyonGpsAlone", canyon_folder, canyon_files, "graphgnss_hk --gps --settings 'use_carrier: %' --raw", false, 0, 0,
     0, ""},
};

evaluate::Statistics score_with_carrier(const GnssDrive& drive, const std::filesystem::path& data, const char* used) {
    const test::TemporaryFolder folder;
    std::string converter = drive.converter;
    converter.replace(converter.find('%'), 1, used);
    GnssDrive one = drive;
    one.converter = converter.c_str();
    return score_drive(convert_drive(one, data, folder.path()));
}

class GnssCarrier : public testing::TestWithParam<GnssDrive> {};

// It is on by default because it does no harm anywhere that was measured: median and 95 % within a twentieth of what
// they are without it, or better.
TEST_P(GnssCarrier, DoesNoHarm) {
    const GnssDrive& drive = GetParam();
    const auto data = test::recorded(drive.folder);
    if (!data) GTEST_SKIP() << "no " << drive.folder << " in LOCUS_DATA or ../shared/data";
    const auto with = score_with_carrier(drive, *data, "true"), without = score_with_carrier(drive, *data, "false");
    const auto& error = drive.less_mean ? with.horizontal_less_bias : with.horizontal;
    const auto& otherwise = drive.less_mean ? without.horizontal_less_bias : without.horizontal;
    const auto held = [](const evaluate::Statistics& score) {
        return score.horizontal_coverage ? 100 * score.horizontal_coverage->share : 0;
    };
    std::printf("%-18s median %.2f -> %.2f m, 95 %% %.2f -> %.2f m, most %.2f -> %.2f m, bound held %.1f -> %.1f %%\n",
                drive.name, otherwise.median_m, error.median_m, otherwise.p95_m, error.p95_m, otherwise.max_m,
                error.max_m, held(without), held(with));
    EXPECT_LT(error.median_m, 1.05 * otherwise.median_m);
    EXPECT_LT(error.p95_m, 1.05 * otherwise.p95_m);
}

INSTANTIATE_TEST_SUITE_P(Recordings, GnssCarrier, testing::ValuesIn(carrier_drives),
                         [](const auto& one) { return std::string(one.param.name); });

} // namespace
} // namespace locus
