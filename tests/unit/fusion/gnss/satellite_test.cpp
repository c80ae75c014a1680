// Orbits: what must hold for any of them. That they are where the satellites are is told by
// tests/replay/single_point_test.cpp.
#include "fusion/geometry/vector.h"
#include "fusion/gnss/satellite.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace locus::gnss {
namespace {

KeplerEphemeris circle(std::uint8_t constellation, std::uint8_t satellite, double a_m, double inclination) {
    KeplerEphemeris e;
    e.constellation = constellation;
    e.satellite = satellite;
    e.week = 2381;
    e.toe_s = e.toc_s = 410400;
    e.root_a = std::sqrt(a_m);
    e.inclination = inclination;
    return e;
}

Eigen::Vector3d at(const auto& e, const GpsTime& time) { return vector(satellite_state(e, time).position_ecef_m); }

TEST(KeplerOrbit, ACircleHasItsRadiusAndComesBackAfterASiderealDay) {
    const double mu = 3.986005e14, day_s = 2 * 3.14159265358979 / 7.2921151467e-5,
                 motion = 4 * 3.14159265358979 / day_s;
    const auto e = circle(constellation::gps, 1, std::cbrt(mu / (motion * motion)), 0.96);
    for (double t = -7200; t <= 7200; t += 600) EXPECT_NEAR(at(e, GpsTime{2381, 410400 + t}).norm(), 26.56e6, 2e4);
    const Eigen::Vector3d before = at(e, {2381, 410400}), after = at(e, GpsTime{2381, 410400} + day_s);
    EXPECT_LT((after - before).norm(), 0.5) << "two revolutions, one turn of the Earth";
}

TEST(KeplerOrbit, VelocityIsTheChangeOfPosition) {
    auto e = circle(constellation::galileo, 1, 29.6e6, 0.98);
    e.week -= galileo_week_ahead;
    e.eccentricity = 0.16;
    e.mean_anomaly = 1;
    const GpsTime time{2381, 411000};
    const Eigen::Vector3d difference = (at(e, time + 0.01) - at(e, time + -0.01)) / 0.02;
    EXPECT_LT((difference - vector(satellite_state(e, time).velocity_ecef_mps)).norm(), 1e-4);
}

TEST(KeplerOrbit, AGeostationarySatelliteStandsStill) {
    auto e = circle(constellation::beidou, 3, 42164.2e3, 5 * 3.1415926535898 / 180);
    e.week -= beidou_week_ahead;
    e.node = 3.1415926535898 + 7.292115e-5 * e.toe_s; // where its orbit goes down is where the frame tilts up
    const GpsTime time{2381, 410414};
    EXPECT_LT((at(e, time + 3600) - at(e, time)).norm(), 2e3);
    EXPECT_LT(std::abs(at(e, time + 1800)[2]), 1) << "on the equator";
    e.satellite = 20;
    EXPECT_GT(std::abs(at(e, time + 1800)[2]), 1e5) << "others tilt with their orbit";
}

TEST(KeplerOrbit, ClockGoesByItsPolynomialAlsoOverTheWeeksEnd) {
    auto e = circle(constellation::gps, 1, 26.56e6, 0.96);
    e.toe_s = e.toc_s = 604784;
    e.clock_s = 1e-4, e.clock_drift = 1e-11, e.clock_drift_rate_per_s = 1e-15;
    const auto state = satellite_state(e, {2382, 84});
    EXPECT_NEAR(state.clock_s, 1e-4 + 1e-11 * 100 + 1e-15 * 1e4, 1e-18);
    EXPECT_NEAR(state.clock_drift, 1e-11 + 2e-15 * 100, 1e-20);
}

TEST(KeplerOrbit, RelativityShowsInTheClock) {
    auto e = circle(constellation::gps, 1, 26.56e6, 0.96);
    e.eccentricity = 0.02;
    e.mean_anomaly = 3.14159265358979 / 2;
    EXPECT_NEAR(satellite_state(e, {2381, 410400}).clock_s, -4.442807633e-10 * 0.02 * e.root_a, 1e-11);
}

TEST(KeplerOrbit, ElementsOfNoOrbitGiveNoPosition) {
    const KeplerEphemeris nothing;
    EXPECT_FALSE(std::isfinite(satellite_state(nothing, {0, 0}).position_ecef_m[0]));
}

GlonassEphemeris glonass() {
    GlonassEphemeris e;
    e.reference = {2381, 410418};
    e.position_m = {11.0e6, -12.0e6, 19.6e6};
    e.velocity_mps = {2200, 1800, -130};
    e.acceleration_mps2 = {9.3e-7, 0, -1.9e-6};
    e.clock_s = -5e-5;
    e.clock_drift = 1e-12;
    return e;
}

TEST(GlonassOrbit, BeginsWhereItIsToldAndComesBack) {
    const GlonassEphemeris e = glonass();
    EXPECT_EQ(satellite_state(e, e.reference).position_ecef_m, e.position_m);
    GlonassEphemeris later = e;
    later.reference = e.reference + 900;
    const SatelliteState state = satellite_state(e, later.reference);
    later.position_m = state.position_ecef_m, later.velocity_mps = state.velocity_ecef_mps;
    EXPECT_LT((at(later, e.reference) - vector(e.position_m)).norm(), 1e-3);
    EXPECT_DOUBLE_EQ(state.clock_s, -5e-5 + 900 * 1e-12);
}

TEST(GlonassOrbit, VelocityIsTheChangeOfPosition) {
    const GlonassEphemeris e = glonass();
    const GpsTime time = e.reference + 500;
    const Eigen::Vector3d difference = (at(e, time + 0.05) - at(e, time + -0.05)) / 0.1;
    EXPECT_LT((difference - vector(satellite_state(e, time).velocity_ecef_mps)).norm(), 1e-4);
}

/// In the frame that does not turn: kinetic and potential energy with J2, which forces of Sun and Moon change little.
double energy(const SatelliteState& s) {
    const Eigen::Vector3d r = vector(s.position_ecef_m), turn{0, 0, 7.292115e-5};
    const Eigen::Vector3d v = vector(s.velocity_ecef_mps) + turn.cross(r);
    const double mu = 3.9860044e14, sine = r[2] / r.norm(), flat = 1.0826257e-3 * std::pow(6378136 / r.norm(), 2);
    return v.squaredNorm() / 2 - mu / r.norm() * (1 - flat * (3 * sine * sine - 1) / 2);
}

TEST(GlonassOrbit, KeepsItsEnergy) {
    GlonassEphemeris e = glonass();
    e.acceleration_mps2 = {};
    const double begin = energy(satellite_state(e, e.reference)), end = energy(satellite_state(e, e.reference + 3600));
    EXPECT_NEAR(end / begin, 1, 1e-9);
}

TEST(GlonassOrbit, FarFromItsReferenceNothingIsKnown) {
    const GlonassEphemeris e = glonass();
    EXPECT_TRUE(std::isnan(satellite_state(e, e.reference + 50000).clock_s));
    EXPECT_TRUE(std::isnan(satellite_state(e, {2381, std::nan("")}).position_ecef_m[0]));
}

} // namespace
} // namespace locus::gnss
