// The range filter on recorded flights with its default settings, one set for all, range differences or ranges only.
// The bars are quick references that came with the data (data README): constant velocity, soft Cauchy weights, no IMU.
#include "fusion/estimators/range_ekf.h"
#include "tests/replay/score.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace locus::crazyflie {
namespace {

struct Bar {
    const char* flight;
    const char* survey;
    double takeoff_height_m; ///< airborne above it
    double rmse_3d_m;
    double rmse_2d_m;
};

std::ostream& operator<<(std::ostream& out, const Bar& bar) { return out << bar.flight; }

// traj3 and the two-way flight have no published reference: the first is held to traj2's, the second to the README's
// figure with one common range error. The two-way flight hovers at 0.15 m.
constexpr Bar bars[]{
    {"0425_tdoa2_traj2", "0425", 0.35, 0.255, 0.103},  {"0425_tdoa2_traj3", "0425", 0.35, 0.255, 0.103},
    {"0425_tdoa3_traj14", "0425", 0.35, 0.334, 0.158}, {"0426_tdoa3_traj5", "0426", 0.35, 0.311, 0.161},
    {"tdoa2_test_log00", "0425", 0.35, 0.261, 0.106},  {"0607_twr_static_log00", "const3", 0.1, 0.13, 0.13},
};

class Flights : public testing::TestWithParam<Bar> {};

TEST_P(Flights, KeepTheirBarsWithAnHonestBound) {
    const auto data = folder();
    if (!data) GTEST_SKIP() << "no util_uwb_tdoa in LOCUS_DATA or ../shared/data";
    const Bar bar = GetParam();
    const Flight flight = load(*data, bar.flight, bar.survey);
    RangeEkf filter(flight.site, {});
    const Score score = run(filter, flight, airborne(flight, bar.takeoff_height_m));
    std::printf(
        "%-22s 3D %.3f 2D %.3f z %.3f worst %.2f m; within the 95 %% bound: 2D %.3f z %.3f 3D %.3f; resets %u\n",
        bar.flight, score.rmse_3d_m, score.rmse_2d_m, score.rmse_z_m, score.worst_m, score.within_2d, score.within_z,
        score.within_3d, score.resets);
    EXPECT_GT(score.ticks, 2000);
    EXPECT_LE(score.rmse_3d_m, bar.rmse_3d_m);
    EXPECT_LE(score.rmse_2d_m, bar.rmse_2d_m);
    EXPECT_GE(score.within_2d, 0.95);
    EXPECT_GE(score.within_z, 0.95);
    EXPECT_GE(score.within_3d, 0.95);
    EXPECT_LE(score.resets, 1u) << "more than the one between the ghost on the landing pad and the truth in the air";
}

INSTANTIATE_TEST_SUITE_P(UtilUwbTdoa, Flights, testing::ValuesIn(bars),
                         [](const auto& flight) { return "Flight" + std::string(flight.param.flight); });

} // namespace
} // namespace locus::crazyflie
