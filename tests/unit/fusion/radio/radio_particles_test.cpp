#include "fusion/engine.h"
#include "fusion/estimators/radio_particles.h"
#include "tests/allocations.h"
#include "tests/unit/fusion/radio/radio_hall.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace locus {
namespace {

using test::hall_beacons;
using test::RadioHall;
using test::SimulatedRadios;

double mean_over_seeds_m(bool with_map, bool unit) {
    double sum_m = 0;
    for (unsigned seed = 1; seed <= 5; ++seed) {
        RadioHall hall(with_map, seed, unit, SimulatedRadios(hall_beacons(), 7 + seed));
        hall.walk(10);
        hall.errors = 0;
        hall.errors_m = 0;
        hall.walk(40);
        sum_m += hall.mean_m() / 5;
    }
    return sum_m;
}

TEST(RadioParticles, StepsAndAMapAreBetterThanAMapAloneAndThatThanAModel) {
    const double both = mean_over_seeds_m(true, true), map = mean_over_seeds_m(true, false),
                 model = mean_over_seeds_m(false, false);
    std::printf("mean error: map and steps %.2f m, map %.2f m, path loss %.2f m\n", both, map, model);
    EXPECT_LT(both, map);
    EXPECT_LT(map, model);
    EXPECT_LT(both, 1);
    EXPECT_LT(model, 5);
}

TEST(RadioParticles, SaysHowEachBeaconFits) {
    RadioHall hall;
    EXPECT_EQ(hall.hear({address(100), -60}).reason, Exclusion::waiting_for_start);
    hall.walk(10);
    EXPECT_EQ(hall.estimate().missing, Missing::nothing);
    const Verdict fits = hall.hear({address(100), hall.radios.expected_dbm(0, hall.walker.position_m())});
    EXPECT_EQ(fits.reason, Exclusion::none);
    EXPECT_LT(fits.test_ratio, 1);
    EXPECT_GT(hall.hear({address(100), 0}).test_ratio, 1);
    EXPECT_EQ(hall.hear({address(999), -60}).reason, Exclusion::unknown_beacon);
    EXPECT_EQ(hall.hear({address(100), -500}).reason, Exclusion::out_of_reach);
    EXPECT_EQ(hall.filter.update({hall.walker.time(), 0, 0, Range{}}).reason, Exclusion::unsupported_kind);
}

TEST(RadioParticles, OneMadReadingHardlyMovesIt) {
    RadioHall hall;
    hall.walk(20);
    const Vec3 before = hall.estimate().position_site_m;
    hall.hear({address(102), -10});
    const Vec3 after = hall.estimate().position_site_m;
    EXPECT_LT(std::hypot(after[0] - before[0], after[1] - before[1]), 0.7);
}

TEST(RadioParticles, FindsSomebodyWhoIsPlainlyElsewhere) {
    RadioHall hall(true, 5, false);
    hall.walker.place({4, 4}, 0);
    hall.walk(10);
    hall.walker.place({16, 8}, 3);
    hall.walk(15);
    EXPECT_LT(hall.error_m(), 4);
}

TEST(RadioParticles, LearnsHowStrongABeaconSends) {
    RadioHall hall(false, 5, false, [] {
        SimulatedRadios strong(hall_beacons(), 8, 1, 2);
        strong.loss.power_1m_dbm = -38; // 12 dB more than the settings say
        return strong;
    }());
    hall.walk(60);
    hall.errors = 0;
    hall.errors_m = 0;
    hall.walk(30);
    EXPECT_LT(hall.mean_m(), 4);
}

TEST(RadioParticles, ACopyGoesOnAsTheFirstToTheBitAndNothingIsAllocated) {
    RadioHall first, second;
    first.walk(12);
    const auto radios = first.radios;
    const test::AllocationCount allocations;
    second.filter.copy_from(first.filter);
    EXPECT_EQ(allocations.made(), 0u);
    second.walker = first.walker;
    second.samples = first.samples;
    second.radios = radios;
    first.walk(5);
    second.walk(5);
    const Estimate a = first.estimate(), b = second.estimate();
    EXPECT_EQ(a.position_site_m, b.position_site_m);
    EXPECT_EQ(a.covariance, b.covariance);
    const std::vector<radio::Reading> heard = first.radios.hear(first.walker.position_m());
    const test::AllocationCount more;
    for (int i = 0; i < 5; ++i) {
        for (const auto& each : heard) first.hear(each);
        first.walker.move(0);
    }
    first.estimate();
    EXPECT_EQ(more.made(), 0u);
}

/// The whole way: a signal strength goes in, a pose comes out, and each beacon has its own status.
TEST(RadioParticles, GivesPosesThroughTheEngine) {
    RadioHall hall;
    EngineSettings settings;
    settings.fusion.estimator = "radio_particles";
    settings.fusion.rate_hz = 10;
    settings.site = hall.site();
    settings.estimators.push_back({&radio_particles_row, std::make_shared<RadioParticlesSettings>(hall.settings)});
    Engine engine(settings);
    std::uint32_t sequence = 0;
    for (int tick = 1; tick <= 50; ++tick) {
        const Timestamp time = timestamp_from_s(0.1 * tick);
        if (tick % 5 == 0)
            for (const auto& each : hall.radios.hear({7, 4}))
                engine.submit(
                    {time, ++sequence, 0, SignalStrength{each.beacon, address(1), static_cast<float>(each.rssi_dbm)}},
                    time);
        engine.step(time);
    }
    const auto poses = engine.step(timestamp_from_s(5.1));
    ASSERT_EQ(poses.size(), 1u);
    EXPECT_EQ(poses[0].estimate.missing, Missing::nothing);
    EXPECT_LT(std::hypot(poses[0].estimate.position_site_m[0] - 7, poses[0].estimate.position_site_m[1] - 4), 3);
    int beacons = 0;
    for (const AidStatus& source : engine.sources())
        beacons += source.kind == SourceKind::beacon && source.counters.used > 0;
    EXPECT_EQ(beacons, 6);
}

} // namespace
} // namespace locus
