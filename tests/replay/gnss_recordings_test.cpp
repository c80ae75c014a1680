// GNSS recordings read whole: how much is in them, and their first and last values.
#include "drivers/gnss/nmea.h"
#include "drivers/gnss/ubx.h"
#include "tests/replay/data.h"
#include "tests/replay/gnss_replay.h"

#include <gtest/gtest.h>

namespace locus::gnss {
namespace {

void expect_place(const GnssFix& fix, double latitude_deg, double longitude_deg, double height_m) {
    EXPECT_NEAR(fix.latitude_deg, latitude_deg, 5e-8);
    EXPECT_NEAR(fix.longitude_deg, longitude_deg, 5e-8);
    EXPECT_NEAR(fix.height_ellipsoid_m, height_m, 5e-4);
}

std::size_t refused(const Replay& replay, Refusal reason) { return replay.refused[static_cast<std::size_t>(reason)]; }

TEST(GnssRecordings, WalkWithUblox) {
    const auto log = test::recorded("gnss_imu_walk_drive/walk_0827/gnss_1730.ubx");
    if (!log) GTEST_SKIP() << "no gnss_imu_walk_drive in LOCUS_DATA or ../shared/data";
    Replay walk;
    replay(make_ubx, UbxSettings{address(0)}, test::bytes_of(*log), walk);
    EXPECT_EQ(walk.frames, 536u + 536 + 2328);
    EXPECT_EQ(walk.fixes.size(), 536u);
    EXPECT_EQ(walk.epochs, 536u);
    EXPECT_EQ(walk.raws.size(), 37850u);
    EXPECT_EQ(walk.navigations, 2328u - 51) << "51 have more than 16 words";
    EXPECT_EQ(refused(walk, Refusal::bad_checksum), 0u);
    EXPECT_EQ(refused(walk, Refusal::malformed), 0u);
    EXPECT_EQ(refused(walk, Refusal::out_of_range), 0u);
    EXPECT_GT(refused(walk, Refusal::garbage), 0u) << "NMEA and RTCM stand between";
    const GnssFix& first = walk.fixes.front();
    const GnssFix& last = walk.fixes.back();
    expect_place(first, 40.0966916, -105.1471665, 1580.048);
    expect_place(last, 40.0966933, -105.1471666, 1579.933);
    EXPECT_EQ(first.fix_type, gnss_fix_type::carrier_fixed);
    EXPECT_EQ(last.fix_type, gnss_fix_type::carrier_float);
    std::printf("fixes %.7f %.7f %.3f type %d ... %.7f %.7f %.3f type %d\n", first.latitude_deg, first.longitude_deg,
                first.height_ellipsoid_m, first.fix_type, last.latitude_deg, last.longitude_deg,
                last.height_ellipsoid_m, last.fix_type);
    const GnssRaw& a = walk.raws.front();
    const GnssRaw& z = walk.raws.back();
    EXPECT_NEAR(a.receiver_time_s_in_gps_week, 408639.748, 1e-6);
    EXPECT_NEAR(a.pseudorange_m, 20576395.496, 5e-4);
    EXPECT_NEAR(z.receiver_time_s_in_gps_week, 408773.498, 1e-6);
    EXPECT_NEAR(z.pseudorange_m, 21774629.833, 5e-4);
    std::printf("raw %d %.3f %d/%d/%d %.3f m ... %.3f %d/%d/%d %.3f m\n", a.gps_week, a.receiver_time_s_in_gps_week,
                a.constellation, a.satellite, a.signal, a.pseudorange_m, z.receiver_time_s_in_gps_week, z.constellation,
                z.satellite, z.signal, z.pseudorange_m);
}

TEST(GnssRecordings, DriveWithNmea) {
    const auto log = test::recorded("google_gnss/NmeaUtils/example/MTV.Local1.ublox-F9K.20200206-181434.nmea");
    if (!log) GTEST_SKIP() << "no google_gnss in LOCUS_DATA or ../shared/data";
    Replay drive;
    replay(make_nmea, NmeaSettings{address(0)}, test::bytes_of(*log), drive);
    const GnssFix& first = drive.fixes.front();
    const GnssFix& last = drive.fixes.back();
    EXPECT_EQ(drive.fixes.size(), 1653u);
    EXPECT_EQ(drive.frames, 45485u);
    EXPECT_EQ(refused(drive, Refusal::bad_checksum), 13u) << "lines whose head stands there twice";
    EXPECT_EQ(refused(drive, Refusal::malformed), 0u);
    expect_place(first, 37.426393667, -122.0936525, -25.6);
    expect_place(last, 37.426391, -122.09365, -25.9);
    std::printf("%zu fixes of %zu sentences, %.9f %.9f %.3f type %d ... %.9f %.9f %.3f type %d\n", drive.fixes.size(),
                drive.frames, first.latitude_deg, first.longitude_deg, first.height_ellipsoid_m, first.fix_type,
                last.latitude_deg, last.longitude_deg, last.height_ellipsoid_m, last.fix_type);
}

} // namespace
} // namespace locus::gnss
