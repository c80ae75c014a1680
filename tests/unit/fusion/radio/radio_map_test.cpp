#include "fusion/radio/floor_posterior.h"
#include "fusion/radio/gaussian_field.h"
#include "fusion/radio/neighbours.h"
#include "fusion/radio/point_gaussians.h"
#include "tests/allocations.h"
#include "tests/unit/fusion/radio/simulated_radios.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace locus::radio {
namespace {

using test::hall_beacons;
using test::SimulatedRadios;

RadioMap three_points() {
    RadioMap map;
    map.points = {{{0, 0, 0}, {{address(1), -50, 0, 1}, {address(2), -70, 0, 1}}},
                  {{4, 0, 0}, {{address(1), -60, 0, 1}, {address(2), -60, 0, 1}}},
                  {{8, 0, 0}, {{address(1), -70, 0, 1}}}};
    return map;
}

TEST(RadioMap, KnowsItsBeaconsItsFloorAndItsSpacing) {
    const RadioMap map = three_points();
    EXPECT_EQ(beacons_of(map), (std::vector{address(1), address(2)}));
    EXPECT_EQ(beacons_of(map, 3), std::vector{address(1)});
    EXPECT_EQ(hearing_floor_dbm(map), -70);
    EXPECT_DOUBLE_EQ(point_spacing_m(map), 4);
    EXPECT_DOUBLE_EQ(point_spacing_m(RadioMap{}), 1);
}

TEST(Neighbours, AreTheMostAlike) {
    const RadioMap map = three_points();
    const std::vector<Reading> heard{{address(1), -58}, {address(2), -62}};
    EXPECT_EQ(nearest_neighbours(map, heard, {1, false}, -80).value(), Eigen::Vector2d(4, 0));
    EXPECT_EQ(nearest_neighbours(map, heard, {2, false}, -80).value(), Eigen::Vector2d(2, 0));
    const double weighted = nearest_neighbours(map, heard, {2, true}, -80).value().x();
    EXPECT_GT(weighted, 2.5); // nearer to the one that is more alike
    EXPECT_LT(weighted, 4);
    EXPECT_FALSE(nearest_neighbours(map, std::vector<Reading>{{address(9), -58}}, {4, false}, -80).has_value());
}

TEST(Neighbours, CountABeaconThatOneSideDidNotHearAsWeak) {
    const RadioMap map = three_points();
    const std::vector<Reading> heard{{address(1), -65}}; // as like to the second as to the third by the first beacon
    EXPECT_EQ(nearest_neighbours(map, heard, {1, false}, -80).value(), Eigen::Vector2d(8, 0));
}

TEST(PathLoss, IsFoundAgain) {
    const PathLoss truth{-41, 2.7, 3};
    std::mt19937 random(7);
    std::normal_distribution<double> normal(0, truth.sigma_db);
    std::vector<StrengthAtDistance> samples;
    for (int i = 0; i < 500; ++i) {
        const double distance_m = 1 + 0.05 * i;
        samples.push_back({distance_m, truth.expected_dbm(distance_m) + normal(random)});
    }
    const auto fit = fit_path_loss(samples);
    ASSERT_TRUE(fit.has_value());
    EXPECT_NEAR(fit->power_1m_dbm, truth.power_1m_dbm, 2);
    EXPECT_NEAR(fit->exponent, truth.exponent, 0.2);
    EXPECT_NEAR(fit->sigma_db, truth.sigma_db, 0.3);
    EXPECT_NEAR(truth.distance_m(truth.expected_dbm(7.5)), 7.5, 1e-9);
    EXPECT_FALSE(fit_path_loss(std::vector<StrengthAtDistance>(5, {2, -60})).has_value());
}

/// Foretells the strengths at places between the points, and how well it does so.
TEST(GaussianField, KnowsWhatItDoesNotKnow) {
    SimulatedRadios radios(hall_beacons(), 3);
    const StrengthGrid grid = gaussian_field(radios.survey(20, 12, 2), {});
    double squares = 0, in_sigma = 0;
    int count = 0;
    for (const double x : {3.0, 7.0, 11.0, 15.0})
        for (const double y : {1.0, 5.0, 9.0})
            for (const Reading& reading : radios.hear({x, y})) {
                const Expected expected =
                    grid.at(grid.index_of(reading.beacon), static_cast<float>(x), static_cast<float>(y));
                const double off = reading.rssi_dbm - double{expected.mean_dbm};
                squares += off * off;
                in_sigma += off * off / double{expected.variance_db2};
                ++count;
            }
    std::printf("%.2f dB root mean square off between the points, %.2f in its own sigmas squared\n",
                std::sqrt(squares / count), in_sigma / count);
    EXPECT_LT(std::sqrt(squares / count), 3.5); // 2 dB are noise; the deviation alone is 4 dB
    EXPECT_GT(in_sigma / count, 0.6);
    EXPECT_LT(in_sigma / count, 1.5);
}

TEST(GaussianField, LocatesBetterThanNeighboursAndPoints) {
    double field_m = 0, neighbours_m = 0, points_m = 0;
    for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
        SimulatedRadios radios(hall_beacons(), seed, 3, 4);
        const RadioMap map = radios.survey(20, 12, 2);
        const StrengthGrid grid = gaussian_field(map, {});
        FloorPosterior posterior(grid.cells().count());
        const double floor_dbm = hearing_floor_dbm(map), spread_db = point_spread_db(map, floor_dbm);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> across(0, 20), along(0, 12);
        for (int i = 0; i < 60; ++i) {
            const double y = along(random), x = across(random);
            const Eigen::Vector2d place(x, y);
            const std::vector<Reading> heard = radios.hear(place);
            std::vector<IndexedReading> readings;
            for (const Reading& each : heard)
                readings.push_back({grid.index_of(each.beacon), static_cast<float>(each.rssi_dbm)});
            field_m += (posterior.solve(grid, readings).position_site_m - place).norm() / 360;
            neighbours_m += (nearest_neighbours(map, heard, {4, false}, floor_dbm).value() - place).norm() / 360;
            points_m += (locate_by_points(map, heard, spread_db, floor_dbm).value() - place).norm() / 360;
        }
    }
    std::printf("field %.2f m, 4-NN %.2f m, point Gaussians %.2f m\n", field_m, neighbours_m, points_m);
    EXPECT_LT(field_m, 0.97 * neighbours_m);
    EXPECT_LT(field_m, points_m);
}

/// At the far end nobody hears the beacons of the near one; that alone tells where one is.
TEST(GaussianField, SilenceIsEvidence) {
    SimulatedRadios radios({{0, 0}, {0, 10}, {40, 5}}, 4, 1, 1, -68);
    const StrengthGrid grid = gaussian_field(radios.survey(40, 10, 2.5), {});
    FloorPosterior posterior(grid.cells().count());
    const std::vector<Reading> near = radios.hear({1, 5});
    ASSERT_EQ(near.size(), 2u);
    const FloorBelief nobody = posterior.solve(grid, {});
    EXPECT_GT(nobody.position_site_m.x(), 10);
    EXPECT_LT(nobody.position_site_m.x(), 32);
    std::vector<IndexedReading> one{{grid.index_of(near[0].beacon), static_cast<float>(near[0].rssi_dbm)}};
    EXPECT_LT(posterior.solve(grid, one).position_site_m.x(), 12);
}

TEST(GaussianField, NothingIsAllocatedWhereItIsRead) {
    SimulatedRadios radios(hall_beacons(), 3);
    const StrengthGrid grid = gaussian_field(radios.survey(20, 12, 4), {});
    FloorPosterior posterior(grid.cells().count());
    const std::vector<IndexedReading> readings{{0, -60}, {3, -71}};
    const test::AllocationCount allocations;
    posterior.solve(grid, readings);
    EXPECT_EQ(allocations.made(), 0u);
}

TEST(GaussianField, RefusesAMapThatSaysNothing) {
    EXPECT_THROW(gaussian_field(RadioMap{}, {}), std::invalid_argument);
    RadioMap silent = three_points();
    for (auto& point : silent.points) point.heard.clear();
    EXPECT_THROW(gaussian_field(silent, {}), std::invalid_argument);
    EXPECT_EQ(gaussian_field(three_points(), {}).beacons(), std::vector{address(1)}); // the other at two points only
}

TEST(FloorCells, StayWithinTheirNumberWhateverTheSize) {
    EXPECT_EQ(cells_over({0, 0}, {4, 2}, 1, 1000).count(), 15u);
    EXPECT_LE(cells_over({-1e5, -1e5}, {1e5, 1e5}, 1e-3, 4096).count(), 4096u);
    EXPECT_LE(cells_over({-1e5, 0}, {1e5, 0}, 1e-3, 4096).count(), 4096u);
    const StrengthGrid grid(cells_over({0, 0}, {4, 2}, 1, 1000), {address(1)}, -90);
    const float nan = std::nanf("");
    for (const float odd : {-1e30f, 1e30f, nan}) EXPECT_EQ(grid.at(0, odd, odd).mean_dbm, -90);
}

} // namespace
} // namespace locus::radio
