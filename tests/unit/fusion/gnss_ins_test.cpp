// The vehicles' estimator on simulated drives: that it starts, aligns, is as sure as it may be, lives on one to three
// satellites, tells bad ones and a jumping clock apart, and drives into a garage without a jump. Seeds are stated.
#include "fusion/estimators/gnss_ins.h"
#include "tests/allocations.h"
#include "tests/support/heavy.h"
#include "tests/unit/fusion/simulated_drive.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace locus {
namespace {

using test::exact_settings;

struct Car {
    Site site;
    test::SimulatedDrive drive;
    GnssIns filter;

    Car(const GnssInsSettings& settings, const test::DriveSettings& told, unsigned seed, Site where = test::town())
        : site(std::move(where)), drive(site, told, seed), filter(site, settings) {}

    /// Up to `until_s`, hearing the first `satellites` five times a second.
    void run(double until_s, std::size_t satellites) {
        while (drive.time_s() < until_s - 1e-6) {
            drive.move();
            filter.update(drive.imu());
            if (++samples_ % 20 == 0)
                for (std::size_t i = 0; i < satellites; ++i) last = filter.update(drive.satellite(i));
        }
    }
    Estimate estimate() const { return filter.predict(drive.now()); }
    double error_m() const {
        return (Eigen::Map<const Eigen::Vector3d>(estimate().position_site_m.data()) - drive.position_site_m()).norm();
    }

    Verdict last;

  private:
    int samples_ = 0;
};

Eigen::VectorXd error_of(const Car& car) {
    const GnssInsTrack& track = car.filter.track();
    const inertial::EcefMotion truth = car.drive.motion();
    Eigen::VectorXd error(gnss_ins_core);
    const Eigen::AngleAxisd turn(truth.body_to_ecef * track.body_to_ecef().conjugate());
    const Eigen::Vector3d attitude = std::remainder(turn.angle(), 2 * std::numbers::pi) * turn.axis();
    for (int axis = 0; axis < 3; ++axis) {
        error(GnssInsTrack::place(axis, 0)) = truth.position_ecef_m(axis) - track.position_m()(axis);
        error(GnssInsTrack::place(axis, 1)) = truth.velocity_ecef_mps(axis) - track.velocity_ecef_mps()(axis);
        error(GnssInsTrack::place(axis, 2)) = attitude(axis);
    }
    error.segment<3>(inertial::accelerometer_bias_at) =
        car.drive.force_bias_mps2() - track.state.segment<3>(inertial::accelerometer_bias_at);
    error.segment<3>(inertial::gyroscope_bias_at) =
        car.drive.rate_bias_radps() - track.state.segment<3>(inertial::gyroscope_bias_at);
    error(clock_offset_at) = car.drive.clock_offset_m() - track.state(clock_offset_at);
    error(clock_drift_at) = car.drive.clock_drift_mps() - track.state(clock_drift_at);
    return error;
}

// 40 drives of 45 s, tight, nine satellites. The mean NEES of the 17 states in the 95 % band of an honest filter, and
// the position error within 1.2 times of what the filter itself says (0.8: nor is it shy).
TEST(GnssIns, SeventeenStatesAreAsSureAsTheyMayBe) {
    constexpr int runs = 40;
    double nees = 0, squares = 0, trace = 0;
    for (unsigned seed = 1; seed <= runs; ++seed) {
        Car car(exact_settings(), {}, seed);
        car.run(45, 9);
        ASSERT_TRUE(car.filter.track().is_inertial()) << seed;
        const Eigen::VectorXd error = error_of(car);
        nees +=
            test::weighed_square(error, car.filter.track().covariance.topLeftCorner<gnss_ins_core, gnss_ins_core>());
        for (int axis = 0; axis < 3; ++axis) {
            squares += error(3 * axis) * error(3 * axis);
            trace += car.filter.track().covariance(3 * axis, 3 * axis);
        }
    }
    const double ratio = std::sqrt(squares / trace);
    std::printf("NEES %.2f of 17, band %.2f to %.2f; error over its own bound %.2f\n", nees / runs,
                test::chi_square_quantile(17 * runs, 0.025) / runs, test::chi_square_quantile(17 * runs, 0.975) / runs,
                ratio);
    EXPECT_GT(nees, test::chi_square_quantile(17 * runs, 0.025));
    EXPECT_LT(nees, test::chi_square_quantile(17 * runs, 0.975));
    EXPECT_LT(ratio, 1.2);
    EXPECT_GT(ratio, 0.8);
}

// The sensor is turned by 20 degrees in the car and nobody tells: the first heading, which is the course, is off by
// that.
TEST(GnssIns, AttitudeConvergesFromTwentyDegrees) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        GnssInsSettings settings;
        settings.non_holonomic = false;
        settings.align_heading_sigma_deg = 20;
        test::DriveSettings drive;
        drive.sensor_yaw_rad = 20 * std::numbers::pi / 180;
        Car car(settings, drive, seed);
        while (!car.filter.track().is_inertial()) car.run(car.drive.time_s() + 0.1, 9);
        const auto off = [&] {
            return car.filter.track().body_to_ecef().angularDistance(car.drive.motion().body_to_ecef) * 180 /
                   std::numbers::pi;
        };
        EXPECT_GT(off(), 15);
        car.run(60, 9);
        EXPECT_LT(off(), 1) << seed;
    }
}

/// Root mean square over ten drives, 30 s after all but the first `satellites` have gone, without the wheels'
/// constraint.
double error_on_few_m(std::size_t satellites) {
    GnssInsSettings settings;
    settings.non_holonomic = false;
    double squares = 0;
    for (unsigned seed = 1; seed <= 10; ++seed) {
        Car car(settings, {}, seed);
        car.run(40, 9);
        car.run(70, satellites);
        EXPECT_EQ(car.last.reason, Exclusion::none);
        squares += car.error_m() * car.error_m();
    }
    return std::sqrt(squares / 10);
}

// One satellite says next to nothing while the clock is unknown; two and three hold what they see.
TEST(GnssIns, LivesOnOneToThreeSatellites) {
    const double none = error_on_few_m(0), one = error_on_few_m(1), two = error_on_few_m(2), three = error_on_few_m(3);
    std::printf("error after 30 s: %.1f m, on 1 satellite %.1f m, on 2 %.1f m, on 3 %.1f m\n", none, one, two, three);
    EXPECT_LT(one, none);
    EXPECT_LT(two, 0.8 * none);
    EXPECT_LT(three, 0.5 * none);
}

TEST(GnssIns, LooselyCoupledFollowsFixes) {
    GnssInsSettings settings;
    settings.coupling = "loose";
    Car car(settings, {}, 6);
    EXPECT_EQ(car.filter.update(car.drive.satellite(0)).reason, Exclusion::disabled);
    for (int second = 1; second <= 60; ++second) {
        car.run(second, 0);
        car.last = car.filter.update(car.drive.fix(1.5, 0.1));
    }
    EXPECT_EQ(car.last.reason, Exclusion::none);
    EXPECT_LT(car.error_m(), 3);
    EXPECT_TRUE(car.filter.track().is_inertial());
    EXPECT_EQ(car.estimate().kinds_used & (1U << Observation(GnssFix{}).index()), 1U << Observation(GnssFix{}).index());
}

TEST(GnssIns, AReflectedSatelliteIsRefusedByItsInnovation) {
    Car car({}, {}, 7);
    car.run(40, 9);
    Measurement reflected = car.drive.satellite(3);
    std::get_if<SatelliteRange>(&reflected.observation)->pseudorange_m += 60;
    const Verdict verdict = car.filter.update(reflected);
    EXPECT_EQ(verdict.reason, Exclusion::innovation_too_large);
    EXPECT_GT(verdict.innovation, 50);
    EXPECT_EQ(car.filter.update(car.drive.satellite(4)).reason, Exclusion::none);
    EXPECT_LT(car.error_m(), 3);
}

TEST(GnssIns, FollowsAReceiverThatSetsItsClock) {
    Car car({}, {}, 8);
    car.run(40, 9);
    car.drive.set_clock(-299792.458);
    EXPECT_EQ(car.filter.update(car.drive.satellite(0)).reason, Exclusion::clock_jumped);
    car.run(42, 9);
    EXPECT_EQ(car.last.reason, Exclusion::none);
    EXPECT_LT(car.error_m(), 3);
    EXPECT_EQ(car.estimate().reset_count, 0U);
}

TEST(GnssIns, WeakAndLowSatellitesAreToldApart) {
    Car car({}, {}, 9);
    car.run(10, 9);
    Measurement weak = car.drive.satellite(1), low = weak;
    std::get_if<SatelliteRange>(&weak.observation)->carrier_to_noise_dbhz = 15;
    std::get_if<SatelliteRange>(&low.observation)->satellite_ecef_m = {0, 0, -2.2e7};
    EXPECT_EQ(car.filter.update(weak).reason, Exclusion::too_weak);
    EXPECT_EQ(car.filter.update(low).reason, Exclusion::too_low);
}

TEST(GnssIns, StandsStillWithoutSatellites) {
    test::DriveSettings standing;
    standing.still_until_s = 1e6;
    standing.force_noise_mps2_rthz = 0.004; // an idling car's
    standing.rate_noise_radps_rthz = 1.4e-4;
    Car car({}, standing, 10);
    car.run(20, 9);
    const Estimate before = car.estimate();
    car.run(80, 0);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(car.estimate().position_site_m[i], before.position_site_m[i], 0.5) << i;
}

TEST(GnssIns, SaysThatTheSiteHasNoOrigin) {
    const Site nowhere;
    test::SimulatedDrive drive(test::town(), {}, 1);
    GnssIns filter(nowhere, {});
    EXPECT_EQ(filter.update(drive.satellite(0)).reason, Exclusion::site_without_origin);
    EXPECT_EQ(filter.predict(drive.now()).missing, Missing::site_origin);
}

TEST(GnssIns, ACopyGoesOnToTheSameBits) {
    Car car({}, {}, 11);
    car.run(20, 9);
    GnssIns copy(car.site, {});
    copy.copy_from(car.filter);
    car.drive.move();
    const Measurement imu = car.drive.imu(), satellite = car.drive.satellite(2);
    for (GnssIns* one : {&car.filter, &copy}) {
        one->update(imu);
        one->update(satellite);
    }
    EXPECT_EQ(car.estimate().position_site_m, copy.predict(car.drive.now()).position_site_m);
    EXPECT_EQ(car.estimate().covariance, copy.predict(car.drive.now()).covariance);
}

TEST(GnssIns, AllocatesNothingOnceItWasMade) {
    Car car({}, {}, 12);
    car.run(1, 9); // GeographicLib's gravity model is made at its first use
    GnssIns copy(car.site, {});
    const test::AllocationCount allocations;
    car.run(20, 9);
    copy.copy_from(car.filter);
    const Estimate estimate = copy.predict(car.drive.now());
    EXPECT_EQ(allocations.made(), 0U);
    EXPECT_EQ(estimate.missing, Missing::nothing);
}

// ---- the garage: nine satellites until 30 s, three until 33 s, none after; anchors along the way from 36 s on

Site garage() {
    Site site = test::town();
    test::SimulatedDrive way(site, {}, 1);
    for (int i = 0; way.time_s() < 75; ++i) {
        way.move();
        if (way.time_s() < 38 || i % 400 != 0) continue;
        const Eigen::Vector3d p = way.position_site_m();
        const double side = i % 800 == 0 ? 5 : -5;
        const auto n = static_cast<std::uint64_t>(i);
        site.anchors.push_back({"A" + std::to_string(i), address(n), {p.x() - side, p.y() + side, 2.8}});
    }
    return site;
}

TEST(GnssIns, DrivesIntoAGarageWithoutAJump) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        GnssInsSettings settings;
        settings.zero_velocity = false;
        Car car(settings, {}, seed, garage());
        car.run(30, 9);
        Eigen::Vector3d before = Eigen::Map<const Eigen::Vector3d>(car.estimate().position_site_m.data());
        double worst_step_m = 0, worst_m = 0;
        for (double until_s = 30.1; until_s < 70; until_s += 0.1) {
            car.run(until_s, until_s < 33 ? 3 : 0);
            for (const Anchor& anchor : car.site.anchors) {
                const Eigen::Vector3d at(anchor.position_site_m[0], anchor.position_site_m[1],
                                         anchor.position_site_m[2]);
                if (until_s > 36 && (at - car.drive.position_site_m()).norm() < 40)
                    car.filter.update(car.drive.range(anchor, 0.1));
            }
            const Estimate now = car.estimate();
            const Eigen::Vector3d position = Eigen::Map<const Eigen::Vector3d>(now.position_site_m.data());
            worst_step_m =
                std::max(worst_step_m, ((position - before) - 0.1 * car.drive.velocity_site_mps()).head<2>().norm());
            before = position;
            if (until_s > 45) worst_m = std::max(worst_m, (position - car.drive.position_site_m()).head<2>().norm());
            EXPECT_EQ(now.missing, Missing::nothing);
        }
        std::printf("garage %u: largest step beside the drive's own %.2f m, worst inside %.2f m\n", seed, worst_step_m,
                    worst_m);
        EXPECT_LT(worst_step_m, 1); // what GNSS and five seconds without anything leave is made good within tenths
        EXPECT_LT(worst_m, 1);
        EXPECT_EQ(car.estimate().reset_count, 0U);
    }
}

} // namespace
} // namespace locus
