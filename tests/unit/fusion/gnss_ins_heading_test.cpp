// The heading of two antennas on simulated drives: it aligns what stands and what is slow, finds how it is mounted, is
// as sure as it may be, and is refused where it is wrong. Seeds are stated.
#include "fusion/estimators/gnss_ins.h"
#include "tests/support/heavy.h"
#include "tests/unit/fusion/simulated_drive.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace locus {
namespace {

constexpr double heading_noise_deg = 0.4;

/// Hears satellites and headings five times a second each.
struct TwoAntennas {
    Site site = test::town();
    test::SimulatedDrive drive;
    GnssIns filter;
    Verdict last;

    TwoAntennas(const GnssInsSettings& settings, const test::DriveSettings& told, unsigned seed)
        : drive(site, told, seed), filter(site, settings) {}

    void run(double until_s, std::size_t satellites, bool headings) {
        for (int samples = 1; drive.time_s() < until_s - 1e-6; ++samples) {
            drive.move();
            filter.update(drive.imu());
            if (samples % 20 != 0) continue;
            for (std::size_t i = 0; i < satellites; ++i) filter.update(drive.satellite(i));
            if (headings) last = filter.update(drive.heading(heading_noise_deg));
        }
    }
    double attitude_error_deg() const {
        return filter.track().body_to_ecef().angularDistance(drive.motion().body_to_ecef) * 180 / std::numbers::pi;
    }
    double error_m() const {
        const Estimate estimate = filter.predict(drive.now());
        return (Eigen::Map<const Eigen::Vector3d>(estimate.position_site_m.data()) - drive.position_site_m())
            .head<2>()
            .norm();
    }
};

test::DriveSettings standing() {
    test::DriveSettings still;
    still.still_until_s = 1e6;
    still.force_noise_mps2_rthz = 0.004; // an idling car's
    still.rate_noise_radps_rthz = 1.4e-4;
    return still;
}

TEST(GnssInsHeading, WhoStandsKnowsWhereToPoint) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        TwoAntennas without({}, standing(), seed), with({}, standing(), seed);
        without.run(20, 9, false);
        with.run(20, 9, true);
        EXPECT_FALSE(without.filter.track().is_inertial());
        ASSERT_TRUE(with.filter.track().is_inertial());
        EXPECT_EQ(with.last.reason, Exclusion::none);
        EXPECT_LT(with.attitude_error_deg(), 1) << seed;
    }
}

/// A fork-lift at 1 m/s, never fast enough for its course to align it, loses all satellites for 20 s.
double error_after_outage_m(bool headings) {
    test::DriveSettings slow;
    slow.pace = 0.1;
    double squares = 0;
    for (unsigned seed = 1; seed <= 10; ++seed) {
        TwoAntennas truck({}, slow, seed);
        truck.run(60, 9, headings);
        truck.run(80, 0, false);
        squares += truck.error_m() * truck.error_m();
    }
    return std::sqrt(squares / 10);
}

TEST(GnssInsHeading, SlowVehiclesLiveThroughOutages) {
    const double without_m = error_after_outage_m(false), with_m = error_after_outage_m(true);
    std::printf("1 m/s, 20 s without satellites: %.2f m, with the heading before them %.2f m\n", without_m, with_m);
    EXPECT_LT(with_m, 0.5 * without_m);
}

/// Antennas that lie across, their bracket off by two degrees.
TEST(GnssInsHeading, FindsHowTheAntennasAreMounted) {
    test::DriveSettings across;
    across.antennas_deg = 92;
    GnssInsSettings settings;
    settings.heading_mounting_deg = 90;
    settings.heading_mounting_sigma_deg = 2;
    for (unsigned seed = 1; seed <= 5; ++seed) {
        TwoAntennas car(settings, across, seed);
        car.run(3, 9, true);
        ASSERT_TRUE(car.filter.track().is_inertial());
        EXPECT_GT(car.attitude_error_deg(), 1.2);
        car.run(90, 9, true);
        EXPECT_LT(car.attitude_error_deg(), 0.4) << seed;
    }
}

/// NEES of the heading alone over 60 drives, in which the bracket is as far off as the filter was told that it may be.
TEST(GnssInsHeading, IsAsSureAsItMayBe) {
    constexpr int runs = 60;
    double nees = 0;
    for (unsigned seed = 1; seed <= runs; ++seed) {
        std::mt19937 random(1000 + seed);
        test::DriveSettings drive;
        drive.antennas_deg = std::normal_distribution<double>()(random);
        GnssInsSettings settings = test::exact_settings();
        settings.heading_error_sigma_deg = 0;
        TwoAntennas car(settings, drive, seed);
        car.run(25, 9, true);
        const inertial::EcefMotion truth = car.drive.motion();
        const Eigen::AngleAxisd turn(truth.body_to_ecef * car.filter.track().body_to_ecef().conjugate());
        const Eigen::Vector3d error = std::remainder(turn.angle(), 2 * std::numbers::pi) * turn.axis();
        Eigen::Matrix3d covariance;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                covariance(i, j) = car.filter.track().covariance(GnssInsTrack::place(i, 2), GnssInsTrack::place(j, 2));
        nees += test::weighed_square(error, covariance);
    }
    std::printf("attitude NEES %.2f of 3, band %.2f to %.2f\n", nees / runs,
                test::chi_square_quantile(3 * runs, 0.025) / runs, test::chi_square_quantile(3 * runs, 0.975) / runs);
    EXPECT_GT(nees, test::chi_square_quantile(3 * runs, 0.025));
    EXPECT_LT(nees, test::chi_square_quantile(3 * runs, 0.975));
}

TEST(GnssInsHeading, WhatIsWrongIsRefusedAndSaysWhy) {
    GnssInsSettings settings;
    settings.heading_baseline_m = 1;
    TwoAntennas car(settings, {}, 3);
    EXPECT_EQ(car.filter.update(car.drive.heading(0.4)).reason, Exclusion::waiting_for_start);
    car.run(0.5, 9, true);
    EXPECT_EQ(car.last.reason, Exclusion::no_attitude) << "half a second does not level it";
    car.run(40, 9, true);
    EXPECT_EQ(car.last.reason, Exclusion::none);
    Measurement miscounted = car.drive.heading(0.4), turned = miscounted;
    std::get_if<Heading>(&miscounted.observation)->baseline_m = 1.06F;
    EXPECT_EQ(car.filter.update(miscounted).reason, Exclusion::wrong_baseline);
    auto* heading = std::get_if<Heading>(&turned.observation);
    heading->heading_deg = std::fmod(heading->heading_deg + 20, 360);
    const Verdict verdict = car.filter.update(turned);
    EXPECT_EQ(verdict.reason, Exclusion::innovation_too_large);
    EXPECT_NEAR(verdict.innovation, 20, 3);
    EXPECT_EQ(car.filter.update(car.drive.heading(0.4)).reason, Exclusion::none);
    settings.use_heading = false;
    TwoAntennas deaf(settings, {}, 3);
    deaf.run(5, 9, true);
    EXPECT_EQ(deaf.last.reason, Exclusion::disabled);
}

/// Over north an innovation is a few degrees, never 359.
TEST(GnssInsHeading, GoesOverNorth) {
    const Site site = test::town();
    const GnssInsObservations observations(site, {});
    test::SimulatedDrive drive(site, {}, 1);
    GnssInsTrack track(observations.motion_model());
    GnssInsStart start;
    start.position_ecef_m = drive.motion().position_ecef_m;
    track.start(start);
    for (int i = 0; i < 150; ++i) {
        drive.move();
        track.sense(drive.exact_imu(), drive.now(), true);
    }
    for (const double forward_deg : {0.5, 359.5, 180.0}) {
        ASSERT_TRUE(track.begin_inertial_towards((90 - forward_deg) * std::numbers::pi / 180, 0.01));
        EXPECT_NEAR(observations.heading(track, {address(1), 0.2}).innovation, std::remainder(0.2 - forward_deg, 360),
                    1e-2);
    }
}

} // namespace
} // namespace locus
