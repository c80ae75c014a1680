// Satellites whose ephemeris is an ellipse with corrections: GPS, QZSS, Galileo, BeiDou.
#include "fusion/gnss/beidou_d1.h"
#include "fusion/gnss/interface_pi.h"
#include "fusion/gnss/satellite.h"

#include <algorithm>
#include <cmath>

namespace locus::gnss {
namespace {

struct Constants {
    double mu_m3ps2;
    double earth_rate_radps;
};

/// Each constellation computes with its own.
Constants constants_of(std::uint8_t constellation) {
    if (constellation == constellation::galileo) return {3.986004418e14, 7.2921151467e-5};
    if (constellation == constellation::beidou) return {3.986004418e14, 7.2921150e-5};
    return {3.986005e14, 7.2921151467e-5};
}

/// Of the reference time, in GPS time.
GpsTime gps_time(const KeplerEphemeris& e, double second_in_week) {
    const GpsTime time{e.week, second_in_week};
    if (e.constellation == constellation::galileo) return GpsTime{time.week + galileo_week_ahead, time.second};
    if (e.constellation == constellation::beidou)
        return GpsTime{time.week + beidou_week_ahead, time.second} + gps_minus_beidou_s;
    return time;
}

/// toc is told without a week: that which brings it closest to toe.
double since_clock_reference_s(const KeplerEphemeris& e, const GpsTime& time) {
    return std::remainder(time - gps_time(e, e.toc_s), week_s);
}

/// M = E - e sin E by Newton's method.
double eccentric_anomaly(double mean_anomaly, double eccentricity) {
    double anomaly = mean_anomaly;
    for (int i = 0; i < 12; ++i)
        anomaly -= (anomaly - eccentricity * std::sin(anomaly) - mean_anomaly) / (1 - eccentricity * std::cos(anomaly));
    return anomaly;
}

double eccentric_anomaly_at(const KeplerEphemeris& e, double since_toe_s) {
    const double a_m = e.root_a * e.root_a;
    const double motion = std::sqrt(constants_of(e.constellation).mu_m3ps2 / (a_m * a_m * a_m));
    return eccentric_anomaly(e.mean_anomaly + (motion + e.mean_motion_difference) * since_toe_s, e.eccentricity);
}

/// Position in the plane of the equator turned by `node`, with the orbit's inclination.
struct InPlane {
    double x_m, y_m, inclination;

    Vec3 turned(double node) const {
        const double across_m = y_m * std::cos(inclination);
        return {x_m * std::cos(node) - across_m * std::sin(node), x_m * std::sin(node) + across_m * std::cos(node),
                y_m * std::sin(inclination)};
    }
};

InPlane in_plane(const KeplerEphemeris& e, double since_toe_s) {
    const double anomaly = eccentric_anomaly_at(e, since_toe_s), a_m = e.root_a * e.root_a;
    const double true_anomaly = std::atan2(std::sqrt(1 - e.eccentricity * e.eccentricity) * std::sin(anomaly),
                                           std::cos(anomaly) - e.eccentricity);
    const double latitude = true_anomaly + e.perigee;
    const double c = std::cos(2 * latitude), s = std::sin(2 * latitude);
    const double u = latitude + e.cuc * c + e.cus * s;
    const double r_m = a_m * (1 - e.eccentricity * std::cos(anomaly)) + e.crc_m * c + e.crs_m * s;
    return {r_m * std::cos(u), r_m * std::sin(u),
            e.inclination + e.inclination_rate * since_toe_s + e.cic * c + e.cis * s};
}

/// A geostationary BeiDou satellite's orbit is told in a frame that is tilted by 5 degrees (table 5-11).
Vec3 geostationary(const KeplerEphemeris& e, const InPlane& plane, double since_toe_s, double earth_rate) {
    const Vec3 p = plane.turned(e.node + e.node_rate * since_toe_s - earth_rate * e.toe_s);
    const double tilt = -5 * interface_pi / 180, turn = earth_rate * since_toe_s;
    const double y = p[1] * std::cos(tilt) + p[2] * std::sin(tilt), z = -p[1] * std::sin(tilt) + p[2] * std::cos(tilt);
    return {p[0] * std::cos(turn) + y * std::sin(turn), -p[0] * std::sin(turn) + y * std::cos(turn), z};
}

Vec3 position_at(const KeplerEphemeris& e, double since_toe_s) {
    const InPlane plane = in_plane(e, since_toe_s);
    const double earth_rate = constants_of(e.constellation).earth_rate_radps;
    if (e.constellation == constellation::beidou && beidou_geostationary(e.satellite))
        return geostationary(e, plane, since_toe_s, earth_rate);
    return plane.turned(e.node + (e.node_rate - earth_rate) * since_toe_s - earth_rate * e.toe_s);
}

/// F e sqrt(A) sin E with F = -2 sqrt(mu) / c^2 (20.3.3.3.3.1).
double relativity_s(const KeplerEphemeris& e, double since_toe_s) {
    constexpr double light_mps = 299792458;
    const double f = -2 * std::sqrt(constants_of(e.constellation).mu_m3ps2) / (light_mps * light_mps);
    return f * e.eccentricity * e.root_a * std::sin(eccentric_anomaly_at(e, since_toe_s));
}

} // namespace

SatelliteState satellite_state(const KeplerEphemeris& e, const GpsTime& time) noexcept {
    constexpr double half_step_s = 0.5; // of the numeric velocity: its error stays below 1e-5 m/s
    const double since_toe_s = time - gps_time(e, e.toe_s), since_toc_s = since_clock_reference_s(e, time);
    SatelliteState state;
    state.position_ecef_m = position_at(e, since_toe_s);
    const Vec3 before = position_at(e, since_toe_s - half_step_s), after = position_at(e, since_toe_s + half_step_s);
    for (std::size_t i = 0; i < 3; ++i) state.velocity_ecef_mps[i] = (after[i] - before[i]) / (2 * half_step_s);
    state.clock_s = e.clock_s + (e.clock_drift + e.clock_drift_rate_per_s * since_toc_s) * since_toc_s +
                    relativity_s(e, since_toe_s);
    state.clock_drift = e.clock_drift + 2 * e.clock_drift_rate_per_s * since_toc_s;
    return state;
}

} // namespace locus::gnss
