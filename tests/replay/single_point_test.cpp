// Single points of recordings against their truth: out of an UBX log under open sky, and out of RINEX between high
// houses.
#include "tests/replay/data.h"
#include "tests/replay/imported.h"
#include "tests/replay/receiver_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

namespace locus::gnss {
namespace {

using Track = std::map<double, Geodetic>; ///< by second of the week

/// "2025/08/28 17:30:39.749 40.0966916 -105.1471665 1601.4350000 ...", all of one day, which begins at `day_s`.
Track read_rtk(const std::filesystem::path& path, double day_s) {
    Track track;
    std::ifstream file(path);
    double hour = 0, minute = 0, second = 0;
    Geodetic at;
    for (std::string line; std::getline(file, line);)
        if (std::sscanf(line.c_str(), "%*d/%*d/%*d %lf:%lf:%lf %lf %lf %lf", &hour, &minute, &second, &at.latitude_deg,
                        &at.longitude_deg, &at.height_ellipsoid_m) == 6)
            track[day_s + 3600 * hour + 60 * minute + second] = at;
    return track;
}

/// "2051,46701,22.30115538,114.17900033,6.59589290"
Track read_seconds(const std::filesystem::path& path) {
    Track track;
    std::ifstream file(path);
    double second = 0;
    Geodetic at;
    for (std::string line; std::getline(file, line);)
        if (std::sscanf(line.c_str(), "%*d,%lf,%lf,%lf,%lf", &second, &at.latitude_deg, &at.longitude_deg,
                        &at.height_ellipsoid_m) == 4)
            track[second] = at;
    return track;
}

/// East and north of the truth at the same time, give or take 20 ms.
std::vector<Eigen::Vector2d> errors_m(const test::ReceiverRun& run, const Track& truth) {
    constexpr double together_s = 0.02;
    std::vector<Eigen::Vector2d> errors;
    for (const auto& one : run.fixes) {
        const double second = to_s(one.time) - std::floor(to_s(one.time) / week_s) * week_s;
        const auto found = truth.lower_bound(second - together_s);
        if (found == truth.end() || found->first > second + together_s) continue;
        const Eigen::Vector3d enu_m = enu_to_ecef(found->second).transpose() * (one.ecef_m() - ecef_m(found->second));
        errors.emplace_back(enu_m.head<2>());
    }
    return errors;
}

struct Figures {
    double median_m, most_m; ///< 50 and 95 % of the length
};

Figures tell(const char* name, const std::vector<Eigen::Vector2d>& errors) {
    std::vector<double> lengths_m;
    for (const auto& error : errors) lengths_m.push_back(error.norm());
    std::ranges::sort(lengths_m);
    const Figures figures{lengths_m[lengths_m.size() / 2], lengths_m[lengths_m.size() * 95 / 100]};
    std::printf("%s: %zu epochs, horizontally median %.2f m, 95 %% %.2f m, most %.2f m\n", name, errors.size(),
                figures.median_m, figures.most_m, lengths_m.back());
    return figures;
}

test::ReceiverRun run(const std::vector<Measurement>& measurements, const std::set<std::uint8_t>& which) {
    test::ReceiverRun run{GnssSettings{}};
    for (const Measurement& m : measurements) {
        const auto* raw = std::get_if<GnssRaw>(&m.observation);
        if (!raw || which.contains(raw->constellation)) run.hear(m);
    }
    run.finish();
    return run;
}

const std::set<std::uint8_t> all{constellation::gps, constellation::galileo, constellation::beidou, constellation::qzss,
                                 constellation::glonass};

/// The walk's RTK stands metres beside every solution without its base (rnx2rtkp 7.4 m E, 4.1 m N): figures with the
/// mean removed tell the rest.
TEST(SinglePoint, OfAWalk) {
    const auto log = test::recorded("gnss_imu_walk_drive/walk_0827/gnss_1730.ubx");
    const auto rtk = test::recorded("gnss_imu_walk_drive/walk_0827/gnss_1730_sf.pos");
    if (!log || !rtk) GTEST_SKIP() << "no gnss_imu_walk_drive in LOCUS_DATA or ../shared/data";
    auto errors = errors_m(run(test::import({*log}).measurements, all), read_rtk(*rtk, 4 * 86400));
    ASSERT_GT(errors.size(), 400u);
    tell("walk_0827 as it is", errors);
    Eigen::Vector2d mean_m{0, 0};
    for (const auto& error : errors) mean_m += error / static_cast<double>(errors.size());
    for (auto& error : errors) error -= mean_m;
    std::printf("mean %.2f m east, %.2f m north\n", mean_m.x(), mean_m.y());
    const Figures figures = tell("walk_0827, mean removed", errors);
    EXPECT_LT(mean_m.norm(), 10);
    EXPECT_LT(figures.median_m, 1) << "two minutes of a receiver that hardly moves";
}

TEST(SinglePoint, BetweenHighHouses) {
    const std::string folder = "graphgnss_hk_tst/gps_solution_TST/";
    const auto truth = test::recorded(folder + "groundTruth_TST.csv");
    if (!truth) GTEST_SKIP() << "no graphgnss_hk_tst in LOCUS_DATA or ../shared/data";
    const auto canyon =
        test::import({*test::recorded(folder + "COM3_190428_124409.obs"), *test::recorded(folder + "hksc1180.19n"),
                      *test::recorded(folder + "hksc1180.19b")});
    const Track track = read_seconds(*truth);
    tell("graphgnss TST, GPS alone", errors_m(run(canyon.measurements, {constellation::gps}), track));
    const Figures figures = tell("graphgnss TST, all", errors_m(run(canyon.measurements, all), track));
    EXPECT_LT(figures.median_m, 12.3) << "a plain single point with GPS alone: 12.3 m";
}

} // namespace
} // namespace locus::gnss
