// Every observation of the vehicles' estimator against differences: the state is moved by an error as the filter means
// it, and the innovation must fall by the jacobian times that error.
#include "fusion/estimators/gnss_ins_observations.h"
#include "fusion/geometry/vector.h"
#include "tests/unit/fusion/jacobian.h"
#include "tests/unit/fusion/simulated_drive.h"

#include <gtest/gtest.h>

#include <functional>

namespace locus {
namespace {

using Observe = std::function<GnssInsScalar(GnssInsTrack&)>;

struct Bench {
    Site site = test::town();
    GnssInsSettings settings;
    test::SimulatedDrive drive{site, {}, 3};

    Bench() {
        settings.gnss_antenna_body_m = {0.8, -0.3, 1.2};
        settings.tag_body_m = {-0.5, 0.4, 1.0};
        settings.axle_body_m = {-1.4, 0.1, -0.3};
        settings.heading_mounting_deg = 70;
        site.anchors.push_back({"A0", address(7), {60, 40, 3}});
        for (int i = 0; i < 1200; ++i) drive.move();
    }

    /// In the middle of a curve, with biases and errors that are not zero.
    GnssInsTrack track(const GnssInsObservations& observations, bool with_sensor) {
        GnssInsTrack track(observations.motion_model());
        GnssInsStart start;
        start.position_ecef_m = drive.motion().position_ecef_m + Eigen::Vector3d(3, -2, 1);
        start.velocity_ecef_mps = drive.motion().velocity_ecef_mps;
        start.velocity_covariance_m2ps2 = Eigen::Matrix3d::Identity() * 1e-4;
        start.clock_offset_m = drive.clock_offset_m();
        track.start(start);
        if (!with_sensor) return track;
        for (int i = 0; i < 300; ++i) {
            drive.move();
            track.predict(0.01);
            track.sense(drive.exact_imu(), drive.now(), false);
        }
        track.begin_inertial(drive.motion().velocity_ecef_mps, 0.1);
        EXPECT_TRUE(track.is_inertial());
        return track;
    }
};

void expect_matches(GnssInsTrack& track, const Observe& observe, double tolerance, const char* what) {
    observe(track); // gives new errors their places
    const GnssInsScalar analytic = observe(track);
    const auto expected = [&](const Eigen::VectorXd& error) {
        GnssInsTrack moved = track;
        moved.move_by(error);
        return -observe(moved).innovation;
    };
    EXPECT_TRUE(test::jacobian_matches(expected, analytic.jacobian.transpose(), Eigen::VectorXd::Zero(track.size()),
                                       tolerance, 1e-3))
        << what;
    EXPECT_GT(analytic.variance, 0) << what;
}

class GnssInsJacobians : public testing::TestWithParam<bool> {};

// Pseudoranges are 2e7 m: differences over a millimetre have 4e-6 of rounding.
TEST_P(GnssInsJacobians, OfSatellitesFixesAndRanges) {
    Bench bench;
    const GnssInsObservations observations(bench.site, bench.settings);
    GnssInsTrack track = bench.track(observations, GetParam());
    auto satellite = std::get<SatelliteRange>(bench.drive.satellite(2).observation);
    for (const std::uint8_t system : {constellation::gps, constellation::galileo}) {
        satellite.constellation = system;
        expect_matches(track, [&](auto& t) { return observations.pseudorange(t, satellite); }, 2e-5, "pseudorange");
        expect_matches(track, [&](auto& t) { return observations.range_rate(t, satellite); }, 2e-5, "range rate");
    }
    track.hold_place(vector(bench.settings.gnss_antenna_body_m));
    const gnss::CarrierSight before = observations.carrier(track, satellite);
    track.predict(0.3);
    expect_matches(
        track, [&](auto& t) { return observations.carrier_change(t, before, before, 0.3); }, 2e-5, "carrier's change");
    const auto fix = std::get<GnssFix>(bench.drive.fix(1, 0.1).observation);
    for (int axis = 0; axis < 3; ++axis) {
        expect_matches(track, [&](auto& t) { return observations.fix_position(t, fix, axis); }, 1e-5, "fix");
        expect_matches(track, [&](auto& t) { return observations.fix_velocity(t, fix, axis); }, 1e-5, "velocity");
    }
    const Range range{address(7), address(1), 50};
    expect_matches(track, [&](auto& t) { return observations.range(t, range, bench.site.anchors[0]); }, 1e-4, "range");
    const Pressure pressure{address(1), 100900};
    expect_matches(track, [&](auto& t) { return observations.pressure(t, pressure); }, 1e-5, "pressure");
    for (int axis = 0; axis < 3; ++axis) {
        expect_matches(track, [&](auto& t) { return observations.standing(t, axis); }, 1e-7, "standing");
        expect_matches(track, [&](auto& t) { return observations.standing_rate(t, axis); }, 1e-7, "standing rate");
    }
}
INSTANTIATE_TEST_SUITE_P(Sensor, GnssInsJacobians, testing::Bool());

TEST(GnssInsJacobian, OfWheelsAndConstraints) {
    Bench bench;
    const GnssInsObservations observations(bench.site, bench.settings);
    GnssInsTrack track = bench.track(observations, true);
    WheelSpeed wheel{address(1), 9};
    wheel.yaw_rate_radps = 0.1F;
    expect_matches(track, [&](auto& t) { return observations.wheel_speed(t, wheel); }, 1e-5, "wheel");
    const Heading heading{address(1), 20};
    expect_matches(track, [&](auto& t) { return observations.heading(t, heading); }, 2e-4, "heading");
    expect_matches(track, [&](auto& t) { return observations.yaw_rate(t, wheel); }, 1e-7, "yaw rate");
    for (const int axis : {1, 2})
        expect_matches(track, [&](auto& t) { return observations.slip(t, axis); }, 2e-5, "slip");
}

} // namespace
} // namespace locus
