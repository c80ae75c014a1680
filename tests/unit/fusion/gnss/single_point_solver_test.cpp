// Single points of a synthetic sky: exact without noise, honest with it, and undisturbed by one wrong satellite.
#include "fusion/gnss/satellite_range.h"
#include "fusion/gnss/single_point.h"
#include "tests/unit/fusion/gnss/synthetic_sky.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

namespace locus::gnss {
namespace {

using synthetic::start;
using synthetic::Truth;

std::vector<SightFrom> sights_of(const std::vector<GnssRaw>& raws) {
    std::vector<SightFrom> sights;
    for (const auto& raw : raws)
        for (const auto& e : synthetic::satellites())
            if (e.constellation == raw.constellation && e.satellite == raw.satellite)
                sights.push_back({*sight_of(raw, Ephemeris{e})});
    return sights;
}

std::optional<SinglePoint> solved(std::vector<SightFrom>& sights, const GnssSettings& settings = {},
                                  const Eigen::Vector3d& near_m = Eigen::Vector3d::Zero()) {
    return SinglePointSolver{settings}.solve(sights, {start, synthetic::ionosphere}, near_m);
}

TEST(SinglePointSolver, WithoutNoiseItFindsTheTruth) {
    const Truth truth;
    auto sights = sights_of(synthetic::epoch(truth, start));
    ASSERT_GE(sights.size(), 15u);
    const auto point = solved(sights);
    ASSERT_TRUE(point);
    EXPECT_TRUE(point->consistent);
    EXPECT_LT((point->position_ecef_m - truth.at(0)).norm(), 1e-3);
    for (int clock = 0; clock < 3; ++clock)
        EXPECT_NEAR(point->clocks_m[static_cast<std::size_t>(clock)], truth.clocks_m[static_cast<std::size_t>(clock)],
                    1e-3);
    ASSERT_TRUE(point->velocity_ecef_mps);
    EXPECT_LT((*point->velocity_ecef_mps - truth.velocity_ecef_mps).norm(), 0.02) << "centimetres of Sagnac's rate";
    EXPECT_NEAR(point->clock_drift_mps, truth.clock_drift_mps, 0.02);
}

TEST(SinglePointSolver, WhereItStartsDoesNotMatter) {
    const Truth truth;
    const auto raws = synthetic::epoch(truth, start);
    for (const Eigen::Vector3d& near_m :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(truth.at(3)), ecef_m({-40, 170, 0}), ecef_m({48, 12, 900e3})}) {
        auto sights = sights_of(raws);
        const auto point = solved(sights, {}, near_m);
        ASSERT_TRUE(point);
        EXPECT_LT((point->position_ecef_m - truth.at(0)).norm(), 1e-3);
    }
}

TEST(SinglePointSolver, OneWrongSatelliteIsFoundAndSaidSo) {
    const Truth truth;
    std::mt19937 random(11);
    for (int round = 0; round < 50; ++round) {
        auto raws = synthetic::epoch(truth, start);
        const std::size_t wrong = random() % raws.size();
        raws[wrong].pseudorange_m += round % 2 ? 150 : -150;
        auto sights = sights_of(raws);
        const auto point = solved(sights);
        ASSERT_TRUE(point);
        const bool below = sights[wrong].reason == Exclusion::too_low;
        EXPECT_TRUE(below || sights[wrong].reason == Exclusion::inconsistent) << round;
        EXPECT_LT((point->position_ecef_m - truth.at(0)).norm(), 1e-3);
    }
}

TEST(SinglePointSolver, FourSatellitesOfOneConstellationAreEnoughAndThreeAreNot) {
    const Truth truth;
    auto raws = synthetic::epoch(truth, start);
    std::erase_if(raws, [](const GnssRaw& raw) { return raw.constellation != constellation::gps; });
    GnssSettings low;
    low.elevation_mask_deg = 0;
    raws.resize(4);
    auto four = sights_of(raws);
    ASSERT_EQ(four.size(), 4u);
    const auto point = solved(four, low);
    ASSERT_TRUE(point);
    EXPECT_LT((point->position_ecef_m - truth.at(0)).norm(), 0.01);
    raws.resize(3);
    auto three = sights_of(raws);
    EXPECT_FALSE(solved(three, low));
}

TEST(SinglePointSolver, SatellitesInOneSpotGivePositionsToNobody) {
    const Truth truth;
    auto raws = synthetic::epoch(truth, start);
    auto sights = sights_of(raws);
    sights.assign(6, sights.front());
    EXPECT_FALSE(solved(sights));
}

/// 400 epochs with the noise that the model says; seed 5.
TEST(SinglePointSolver, ErrorsAreAsLargeAsTheCovarianceSays) {
    const Truth truth;
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    const auto exact = sights_of(synthetic::epoch(truth, start));
    const SinglePointSolver solver{GnssSettings{}};
    const Sky sky{start, synthetic::ionosphere};
    auto at_truth = exact;
    solver.observer().observe(at_truth, sky, truth.at(0));
    double nees = 0, velocity_nees = 0;
    int consistent = 0;
    constexpr int rounds = 400;
    for (int round = 0; round < rounds; ++round) {
        auto sights = exact;
        for (std::size_t i = 0; i < sights.size(); ++i) {
            sights[i].sight.code_m += normal(random) * std::sqrt(at_truth[i].variance_m2);
            sights[i].sight.rate_mps += normal(random) * std::sqrt(at_truth[i].rate_variance_m2ps2);
        }
        const auto point = solver.solve(sights, sky, truth.at(0));
        ASSERT_TRUE(point);
        const Eigen::Vector3d error_m = point->position_ecef_m - truth.at(0);
        const Eigen::Vector3d rate_error = *point->velocity_ecef_mps - truth.velocity_ecef_mps;
        nees += error_m.dot(point->covariance_m2.llt().solve(error_m)) / rounds;
        velocity_nees += rate_error.dot(point->velocity_covariance_m2ps2.llt().solve(rate_error)) / rounds;
        consistent += std::ranges::none_of(sights, [](const auto& s) { return s.reason == Exclusion::inconsistent; });
    }
    // Chi-square with 3 degrees of freedom: mean 3, and of 400 its standard deviation is sqrt(6 / 400) = 0.12.
    EXPECT_NEAR(nees, 3, 4 * 0.12);
    EXPECT_NEAR(velocity_nees, 3, 4 * 0.12);
    EXPECT_GE(consistent, rounds - 5) << "1 in 1000 is a false alarm";
}

TEST(SatelliteRange, IsTheDistanceAndTheClock) {
    const Truth truth;
    const auto raws = synthetic::epoch(truth, start);
    auto sights = sights_of(raws);
    ASSERT_TRUE(solved(sights));
    for (std::size_t i = 0; i < raws.size(); ++i) {
        if (sights[i].reason != Exclusion::none) continue;
        const SatelliteRange range = satellite_range(raws[i], sights[i]);
        const double clock_m = truth.clocks_m[static_cast<std::size_t>(clock_of(range.constellation))];
        const Eigen::Vector3d way_m = vector(range.satellite_ecef_m) - truth.at(0);
        EXPECT_NEAR(range.pseudorange_m, way_m.norm() + clock_m, 2e-3);
        const Eigen::Vector3d satellite_mps{range.satellite_velocity_ecef_mps[0], range.satellite_velocity_ecef_mps[1],
                                            range.satellite_velocity_ecef_mps[2]};
        const double rate = way_m.normalized().dot(satellite_mps - truth.velocity_ecef_mps);
        EXPECT_NEAR(range.range_rate_mps, rate + truth.clock_drift_mps, 0.03);
        EXPECT_GT(range.sigma_m, 1);
        EXPECT_LT(range.sigma_m, 15);
        EXPECT_EQ(range.lock_s, 10);
    }
}

TEST(SatelliteRange, CarrierGoesAlongWithTheCode) {
    Truth truth;
    const auto carrier_less_code = [&](double since_s) {
        Truth then = truth;
        then.position_ecef_m = truth.at(since_s);
        for (double& clock_m : then.clocks_m) clock_m += truth.clock_drift_mps * since_s;
        const auto raws = synthetic::epoch(then, start + since_s);
        auto sights = sights_of(raws);
        EXPECT_TRUE(SinglePointSolver{GnssSettings{}}.solve(sights, {start + since_s, synthetic::ionosphere},
                                                            then.position_ecef_m));
        std::vector<double> differences;
        for (const auto& s : sights)
            if (s.reason == Exclusion::none) differences.push_back(s.carrier_m - s.range_m);
        return differences;
    };
    const auto before = carrier_less_code(0), after = carrier_less_code(30);
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(after[i], before[i], 1e-3);
}

} // namespace
} // namespace locus::gnss
