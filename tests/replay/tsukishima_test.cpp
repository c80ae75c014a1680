// The very drive of paper 002 (Tsukishima, second test) through its converter, the engine and the scoring of
// `locus evaluate`: docs/accuracy.md. The truth has an offset that every solution shares, so the bars are on errors
// less their mean; they are the better of the paper's own and a quick reference's that came with the data.
#include "config/load.h"
#include "tests/replay/data.h"
#include "tests/support/temporary_folder.h"
#include "tools/evaluate/read.h"
#include "tools/evaluate/statistics.h"
#include "tools/replay/replay.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

namespace locus {
namespace {

struct DriveCase {
    const char* name;
    const char* settings;
    double east_95_m, north_95_m, east_most_m, north_most_m;
};

std::ostream& operator<<(std::ostream& out, const DriveCase& one) { return out << one.name; }

constexpr const char* tight_bare =
    "coupling: tight, use_wheel_speed: false, non_holonomic: false, zero_velocity: false, "
    "use_pressure: false";
constexpr const char* loose_bare =
    "coupling: loose, use_wheel_speed: false, non_holonomic: false, zero_velocity: false, "
    "use_pressure: false";

class Tsukishima : public testing::TestWithParam<DriveCase> {};

std::string converted(const DriveCase& one, const std::filesystem::path& data, const std::string& folder) {
    const std::string command = std::string("python3 '") + LOCUS_SOURCE_DIR + "/tools/convert/ixr_tsukishima' '" +
                                data.string() + "' --settings '" + one.settings + "' --out '" + folder +
                                "' > /dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0) << command; // NOLINT(cert-env33-c,concurrency-mt-unsafe): one thread
    return folder + "/tsukishima";
}

TEST_P(Tsukishima, KeepsItsBarsLessTheOffsetOfTheTruth) {
    const DriveCase one = GetParam();
    const auto data = test::recorded("ixr_tsukishima_car");
    if (!data) GTEST_SKIP() << "no ixr_tsukishima_car in LOCUS_DATA or ../shared/data";
    const test::TemporaryFolder folder;
    const std::string stem = converted(one, *data, folder.path());
    const auto loaded = load_settings(stem + ".site.yaml");
    ASSERT_TRUE(loaded.settings.has_value());
    const auto poses = stem + ".poses.jsonl";
    const auto summary = replay::replay(
        *loaded.settings, {stem + ".jsonl", {poses}, ""}); // NOLINT(bugprone-unchecked-optional-access): the line above
    EXPECT_EQ(summary.read.bad_lines, 0U);
    const auto pairs = associate(evaluate::read_truth(stem + ".truth.tum"), evaluate::read_estimate(poses), {}).pairs;
    ASSERT_GT(pairs.size(), 50'000U);
    const evaluate::Statistics score = evaluate::statistics(pairs, {});
    const auto& [east, north, up] = score.axes_less_bias;
    std::printf(
        "%-16s E / N less mean: 95 %% %.2f / %.2f m, max %.2f / %.2f m, std %.2f / %.2f m; mean %.2f / %.2f m\n",
        one.name, east.p95_m, north.p95_m, east.max_m, north.max_m, east.rmse_m, north.rmse_m, score.bias_m[0],
        score.bias_m[1]);
    EXPECT_LE(east.p95_m, one.east_95_m);
    EXPECT_LE(north.p95_m, one.north_95_m);
    EXPECT_LE(east.max_m, one.east_most_m);
    EXPECT_LE(north.max_m, one.north_most_m);
}

// Tight: the quick reference's bars, all below the paper's (1.70 / 1.97, 2.26 / 2.45). Loose with constraints: 1.54 and
// its maxima are the paper's, north's 95 % the paper's too (the quick reference's 1.15 is not met). Loose without any:
// the quick reference's 95 % and the paper's maxima.
INSTANTIATE_TEST_SUITE_P(Drive, Tsukishima,
                         testing::Values(DriveCase{"Tight", "coupling: tight", 1.25, 1.36, 2.26, 2.32},
                                         DriveCase{"Loose", "coupling: loose", 1.54, 2.11, 4.22, 6.35},
                                         DriveCase{"TightBare", tight_bare, 1.70, 1.97, 2.26, 2.45},
                                         DriveCase{"LooseBare", loose_bare, 2.13, 1.96, 4.22, 6.35}),
                         [](const auto& one) { return std::string(one.param.name); });

} // namespace
} // namespace locus
