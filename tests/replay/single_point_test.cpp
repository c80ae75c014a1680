// Satellite positions and clocks against the truth: a position from the pseudoranges of a recording and nothing else
// lies within metres of where the receiver knew itself to be to centimetres (RTK).
#include "drivers/gnss/ubx.h"
#include "fusion/gnss/satellite.h"
#include "tests/replay/data.h"
#include "tests/replay/gnss_replay.h"
#include "tests/replay/single_point.h"

#include <gtest/gtest.h>

namespace locus::gnss {
namespace {

constexpr double frequency_l1_hz = 1575.42e6;

/// Two signals that together know nothing of the ionosphere.
struct Pair {
    std::uint8_t constellation, second_signal; ///< beside that at L1, whose number is 0
    double second_hz;
    int clock; ///< column of the receiver's clock in the equations
};
constexpr Pair pairs[]{{constellation::gps, 3, 1227.60e6, 3}, {constellation::galileo, 4, 1176.45e6, 4}};

/// I/NAV gives the clock for E1 with E5b, GPS that for L1 with L2.
double delay_s(const KeplerEphemeris& e) {
    return e.constellation == constellation::galileo ? e.group_delay_s[1] - e.group_delay_s[0] : 0;
}

/// Of the last epoch.
const GnssRaw* find(const Replay& replay, const KeplerEphemeris& e, std::uint8_t signal) {
    for (const GnssRaw& raw : replay.raws) {
        const bool last = replay.now - GpsTime{raw.gps_week, raw.receiver_time_s_in_gps_week} == 0;
        if (last && raw.constellation == e.constellation && raw.satellite == e.satellite && raw.signal == signal)
            return &raw;
    }
    return nullptr;
}

std::vector<test::Ray> rays_of(const Replay& replay) {
    std::vector<test::Ray> rays;
    for (const auto& [name, ephemeris] : replay.ephemerides) {
        const auto& e = std::get<KeplerEphemeris>(ephemeris);
        for (const Pair& pair : pairs) {
            const GnssRaw* first = find(replay, e, 0);
            const GnssRaw* second = find(replay, e, pair.second_signal);
            if (pair.constellation != e.constellation || e.health != 0 || !first || !second) continue;
            const double ratio = std::pow(frequency_l1_hz / pair.second_hz, 2);
            const double range_m = (ratio * first->pseudorange_m - second->pseudorange_m) / (ratio - 1);
            rays.push_back(test::ray_of(e, replay.now, range_m, delay_s(e), pair.clock));
        }
    }
    return rays;
}

TEST(SinglePoint, LiesWithinMetresOfTheReceiversOwnFix) {
    const auto log = test::recorded("gnss_imu_walk_drive/walk_0827/gnss_1730.ubx");
    if (!log) GTEST_SKIP() << "no gnss_imu_walk_drive in LOCUS_DATA or ../shared/data";
    Replay walk;
    replay(make_ubx, UbxSettings{address(0)}, test::bytes_of(*log), walk);
    const auto rays = rays_of(walk);
    ASSERT_GE(rays.size(), 8u);
    const GnssFix& fix = walk.fixes.back();
    const Eigen::Vector3d truth_m = test::ecef_m(fix.latitude_deg, fix.longitude_deg, fix.height_ellipsoid_m);
    const Eigen::Vector3d error_m = test::position_m(rays) - truth_m;
    const double up_m = test::up_m(error_m, truth_m), horizontal_m = test::horizontal_m(error_m, truth_m);
    std::printf("%zu satellites: %.2f m horizontally, %.2f m up\n", rays.size(), horizontal_m, up_m);
    EXPECT_LT(horizontal_m, 10); // of one epoch, in hand; a wrong field of an ephemeris makes hundreds of metres
    EXPECT_LT(std::abs(up_m), 15);
}

} // namespace
} // namespace locus::gnss
