// Files of receivers imported whole: how much is in them, their first and last values. single_point_test.cpp and
// rtklib_test.cpp say where they put the receiver.
#include "tests/replay/data.h"
#include "tests/replay/imported.h"

#include <gtest/gtest.h>

#include <set>

namespace locus::importing {
namespace {

using test::import;
using test::Imported;

template <class Kind>
std::vector<Kind> all_of(const Imported& imported) {
    std::vector<Kind> all;
    for (const auto& m : imported.measurements)
        if (const auto* one = std::get_if<Kind>(&m.observation)) all.push_back(*one);
    return all;
}

TEST(Import, WalkOfAnUbxLog) {
    const auto log = test::recorded("gnss_imu_walk_drive/walk_0827/gnss_1730.ubx");
    if (!log) GTEST_SKIP() << "no gnss_imu_walk_drive in LOCUS_DATA or ../shared/data";
    const auto walk = import({*log});
    EXPECT_EQ(walk.counts.at("GNSS_FIX"), 536u);
    EXPECT_EQ(walk.counts.at("GNSS_RAW"), 37850u);
    EXPECT_EQ(walk.counts.at("GNSS_NAVIGATION"), 2328u - 51) << "51 have more than 16 words";
    EXPECT_EQ(walk.reports[0].refused[static_cast<std::size_t>(Refusal::bad_checksum)], 0u);
    EXPECT_EQ(walk.reports[0].bad, 0u);
    constexpr double week_begin_s = 2381 * 604800.0;
    EXPECT_EQ(walk.measurements.front().time, timestamp_from_s(week_begin_s + 408639.748));
    EXPECT_EQ(walk.measurements.back().time, timestamp_from_s(week_begin_s + 408773.5)) << "iTOW of the last NAV-PVT";
}

TEST(Import, DriveOfAnNmeaLog) {
    const auto log = test::recorded("google_gnss/NmeaUtils/example/MTV.Local1.ublox-F9K.20200206-181434.nmea");
    if (!log) GTEST_SKIP() << "no google_gnss in LOCUS_DATA or ../shared/data";
    const auto drive = import({*log});
    EXPECT_EQ(drive.counts.at("GNSS_FIX"), 1653u);
    EXPECT_EQ(drive.reports[0].refused[static_cast<std::size_t>(Refusal::bad_checksum)], 13u);
    // 02:14:17 on 7 February 2020 in UTC: day 14647 since 1980-01-06, 18 leap seconds.
    EXPECT_EQ(drive.measurements.front().time, timestamp_from_s(14642 * 86400.0 + 8057 + 18));
    EXPECT_EQ(drive.measurements.back().time - drive.measurements.front().time, std::chrono::seconds{1727});
}

Imported hong_kong() {
    const std::string folder = "graphgnss_hk_tst/gps_solution_TST/";
    std::vector<std::filesystem::path> paths;
    for (const char* name : {"COM3_190428_124409.obs", "hksc1180.19n", "hksc1180.19b"})
        if (const auto path = test::recorded(folder + name)) paths.push_back(*path);
    return paths.size() == 3 ? import(paths) : Imported{};
}

TEST(Import, CanyonOfRinex) {
    const auto canyon = hong_kong();
    if (canyon.measurements.empty()) GTEST_SKIP() << "no graphgnss_hk_tst in LOCUS_DATA or ../shared/data";
    for (const auto& report : canyon.reports) EXPECT_EQ(report.bad, 0u) << report.path;
    const auto raws = all_of<GnssRaw>(canyon);
    EXPECT_EQ(raws.size(), 26146u) << "lines of satellites in the file";
    EXPECT_EQ(raws.front().pseudorange_m, 21600712.022);
    EXPECT_EQ(raws.front().carrier_cycles, 113512506.876);
    EXPECT_EQ(raws.front().doppler_hz, 445.146);
    EXPECT_EQ(raws.front().receiver_time_s_in_gps_week, 45873.997);
    EXPECT_EQ(raws.front().gps_week, 2051);
    EXPECT_EQ(raws.back().pseudorange_m, 37992919.895);
    EXPECT_EQ(raws.back().satellite, 13);
    std::set<double> epochs;
    for (const auto& raw : raws) epochs.insert(raw.receiver_time_s_in_gps_week);
    EXPECT_EQ(epochs.size(), 1760u);
}

} // namespace
} // namespace locus::importing
