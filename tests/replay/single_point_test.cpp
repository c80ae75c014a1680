// Satellite positions and clocks against the truth: a position from the pseudoranges of a recording and nothing else
// lies within metres of where the receiver knew itself to be to centimetres (RTK).
#include "drivers/gnss/ubx.h"
#include "fusion/gnss/satellite.h"
#include "tests/replay/data.h"
#include "tests/replay/gnss_replay.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <numbers>

namespace locus::gnss {
namespace {

constexpr double light_mps = 299792458, earth_rate_radps = 7.2921151467e-5;
constexpr double frequency_l1_hz = 1575.42e6;

/// WGS-84.
Eigen::Vector3d ecef_m(const GnssFix& fix) {
    constexpr double a_m = 6378137, e2 = 6.69437999014e-3, rad = std::numbers::pi / 180;
    const double sine = std::sin(fix.latitude_deg * rad), n_m = a_m / std::sqrt(1 - e2 * sine * sine);
    const double across_m = (n_m + fix.height_ellipsoid_m) * std::cos(fix.latitude_deg * rad);
    return {across_m * std::cos(fix.longitude_deg * rad), across_m * std::sin(fix.longitude_deg * rad),
            (n_m * (1 - e2) + fix.height_ellipsoid_m) * sine};
}

/// Two signals that together know nothing of the ionosphere.
struct Pair {
    std::uint8_t constellation, second_signal; ///< beside that at L1, whose number is 0
    double second_hz;
    int clock; ///< column of the receiver's clock in the equations
};
constexpr Pair pairs[]{{constellation::gps, 3, 1227.60e6, 3}, {constellation::galileo, 4, 1176.45e6, 4}};

struct Ray {
    Eigen::Vector3d satellite_m; ///< in the Earth's frame of the moment of reception
    double range_m;
    int clock;
};

double satellite_clock_s(const KeplerEphemeris& e, const GpsTime& time) {
    const double clock_s = satellite_state(e, time).clock_s;
    // I/NAV gives the clock for E1 with E5b, GPS that for L1 with L2.
    const bool galileo = e.constellation == constellation::galileo;
    return galileo ? clock_s + e.group_delay_s[0] - e.group_delay_s[1] : clock_s;
}

Ray ray_of(const KeplerEphemeris& e, const GpsTime& received, double pseudorange_m, int clock) {
    const double travel_s = pseudorange_m / light_mps;
    const double clock_s = satellite_clock_s(e, received + -travel_s);
    const auto state = satellite_state(e, received + (-travel_s - clock_s));
    const Eigen::AngleAxisd turn(-earth_rate_radps * travel_s, Eigen::Vector3d::UnitZ());
    return {turn * Eigen::Vector3d(state.position_ecef_m.data()), pseudorange_m + clock_s * light_mps, clock};
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

std::vector<Ray> rays_of(const Replay& replay) {
    std::vector<Ray> rays;
    for (const auto& [name, ephemeris] : replay.ephemerides) {
        const auto& e = std::get<KeplerEphemeris>(ephemeris);
        for (const Pair& pair : pairs) {
            const GnssRaw* first = find(replay, e, 0);
            const GnssRaw* second = find(replay, e, pair.second_signal);
            if (pair.constellation != e.constellation || e.health != 0 || !first || !second) continue;
            const double ratio = std::pow(frequency_l1_hz / pair.second_hz, 2);
            const double range_m = (ratio * first->pseudorange_m - second->pseudorange_m) / (ratio - 1);
            rays.push_back(ray_of(e, replay.now, range_m, pair.clock));
        }
    }
    return rays;
}

/// 2.4 m upwards through the troposphere, longer the flatter.
double troposphere_m(const Eigen::Vector3d& at_m, const Eigen::Vector3d& satellite_m) {
    return at_m.norm() < 6e6 ? 0 : 2.4 / std::max(0.1, (satellite_m - at_m).normalized().dot(at_m.normalized()));
}

Eigen::Vector3d position_m(const std::vector<Ray>& rays) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(5);
    for (int round = 0; round < 10; ++round) {
        Eigen::MatrixXd a = Eigen::MatrixXd::Zero(static_cast<int>(rays.size()), 5);
        Eigen::VectorXd b(static_cast<int>(rays.size()));
        for (int i = 0; i < b.size(); ++i) {
            const Ray& ray = rays[static_cast<std::size_t>(i)];
            const Eigen::Vector3d at_m = x.head<3>(), way_m = ray.satellite_m - at_m;
            a.row(i).head<3>() = -way_m.normalized();
            a(i, ray.clock) = 1;
            b[i] = ray.range_m - troposphere_m(at_m, ray.satellite_m) - way_m.norm() - x[ray.clock];
        }
        x += a.colPivHouseholderQr().solve(b);
    }
    return x.head<3>();
}

TEST(SinglePoint, LiesWithinMetresOfTheReceiversOwnFix) {
    const auto log = test::recorded("gnss_imu_walk_drive/walk_0827/gnss_1730.ubx");
    if (!log) GTEST_SKIP() << "no gnss_imu_walk_drive in LOCUS_DATA or ../shared/data";
    Replay walk;
    replay(make_ubx, UbxSettings{address(0)}, test::bytes_of(*log), walk);
    const auto rays = rays_of(walk);
    ASSERT_GE(rays.size(), 8u);
    const Eigen::Vector3d truth_m = ecef_m(walk.fixes.back()), error_m = position_m(rays) - truth_m;
    const double up_m = error_m.dot(truth_m.normalized());
    const double horizontal_m = (error_m - up_m * truth_m.normalized()).norm();
    std::printf("%zu satellites: %.2f m horizontally, %.2f m up\n", rays.size(), horizontal_m, up_m);
    EXPECT_LT(horizontal_m, 10); // of one epoch, in hand; a wrong field of an ephemeris makes hundreds of metres
    EXPECT_LT(std::abs(up_m), 15);
}

} // namespace
} // namespace locus::gnss
