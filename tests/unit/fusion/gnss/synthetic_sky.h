// Satellites that were never launched, and what a receiver at a known place measures of them: the observations are made
// from the true time of sending and reception, the way round that the single point does not go.
#pragma once

#include "fusion/geometry/earth.h"
#include "fusion/geometry/vector.h"
#include "fusion/gnss/atmosphere.h"
#include "fusion/gnss/satellite.h"
#include "fusion/gnss/sight.h"
#include "fusion/gnss/signals.h"

#include <cmath>
#include <random>
#include <vector>

namespace locus::gnss::synthetic {

inline const GpsTime start{2381, 408600};
inline const Klobuchar ionosphere{{1.5e-8, 2.2e-8, -6e-8, -1.2e-7}, {1.1e5, 1.3e5, -2e5, -3.3e5}};

/// Circles in three planes; the clock and group delay of each its own.
inline KeplerEphemeris circle(std::uint8_t constellation, std::uint8_t number, double a_m) {
    KeplerEphemeris e;
    e.constellation = constellation;
    e.satellite = number;
    e.issue = e.issue_clock = 7;
    e.week = start.week;
    e.toe_s = e.toc_s = 410400;
    if (constellation == constellation::galileo) e.week -= galileo_week_ahead;
    if (constellation == constellation::beidou) e.week -= beidou_week_ahead, e.toe_s = e.toc_s = 410400 - 16;
    e.root_a = std::sqrt(a_m);
    e.eccentricity = 0.003 * (number % 5);
    e.inclination = 0.96;
    const int plane = number % 3, place = number / 3;
    e.node = std::remainder(2.0943951 * plane + 0.3 * constellation, 6.2831853);
    e.mean_anomaly = std::remainder(0.7853982 * place + 0.26 * plane, 6.2831853);
    e.clock_s = 2e-5 * (number % 7 - 3);
    e.clock_drift = 1e-12 * (number % 4);
    e.group_delay_s = {-5e-9 + 1e-9 * (number % 6), 3e-9};
    return e;
}

/// 24 of each of GPS, Galileo and BeiDou. In the fields' own steps, so that words tell the same.
inline std::vector<KeplerEphemeris> satellites() {
    std::vector<KeplerEphemeris> all;
    for (std::uint8_t number = 6; number < 30; ++number) {
        all.push_back(circle(constellation::gps, number, 26.56e6));
        all.push_back(circle(constellation::galileo, number, 29.6e6));
        all.push_back(circle(constellation::beidou, number, 27.9e6));
    }
    return all;
}

struct Truth {
    Eigen::Vector3d position_ecef_m = ecef_m({48.1, 11.6, 520});
    Eigen::Vector3d velocity_ecef_mps{8, -5, 3};
    std::array<double, clock_count> clocks_m{21e3, 21e3 + 12, 21e3 - 40, 21e3 + 7};
    double clock_drift_mps = 95;

    /// At `since_s` after the moment that is described.
    Eigen::Vector3d at(double since_s) const { return position_ecef_m + velocity_ecef_mps * since_s; }
};

struct Way {
    double distance_m; ///< with the satellite's clock and group delay
    double elevation_rad, air_m, ionosphere_m;
};

inline Way way(const KeplerEphemeris& e, const Truth& truth, const GpsTime& received, double since_s) {
    const Eigen::Vector3d at_m = truth.at(since_s);
    double travel_s = 0.07;
    Eigen::Vector3d from_m;
    SatelliteState state;
    for (int i = 0; i < 6; ++i) {
        state = satellite_state(e, received + (since_s - travel_s));
        const Eigen::AngleAxisd turn(-earth_rate_radps * travel_s, Eigen::Vector3d::UnitZ());
        from_m = turn * vector(state.position_ecef_m);
        travel_s = (from_m - at_m).norm() / light_mps;
    }
    const Geodetic at = geodetic(at_m);
    const LookAngles look = look_angles(enu_to_ecef(at), from_m - at_m);
    const double delay_s = e.group_delay_s[e.constellation == constellation::galileo ? 1 : 0];
    const double slower = std::pow(1575.42e6 / carrier_hz(e.constellation, 0), 2);
    return {travel_s * light_mps - light_mps * (state.clock_s - delay_s), look.elevation_rad,
            troposphere_m(at, look.elevation_rad), slower * ionosphere_l1_m(ionosphere, received, at, look)};
}

/// `received`: by the receiver's clock, which goes wrong by the truth's.
inline GnssRaw observe(const KeplerEphemeris& e, const Truth& truth, const GpsTime& received) {
    const double clock_m = truth.clocks_m[static_cast<std::size_t>(clock_of(e.constellation))];
    const GpsTime really = received + -clock_m / light_mps;
    const auto code_m = [&](double since_s) {
        const Way w = way(e, truth, really, since_s);
        return w.distance_m + w.air_m + w.ionosphere_m + clock_m + truth.clock_drift_mps * since_s;
    };
    const Way w = way(e, truth, really, 0);
    const double wavelength_m = light_mps / carrier_hz(e.constellation, 0);
    GnssRaw raw;
    raw.tag = address(7);
    raw.receiver_time_s_in_gps_week = received.second;
    raw.gps_week = static_cast<std::uint16_t>(received.week);
    raw.constellation = e.constellation;
    raw.satellite = e.satellite;
    raw.pseudorange_m = code_m(0);
    raw.carrier_cycles = (code_m(0) - 2 * w.ionosphere_m + 1000) / wavelength_m;
    raw.doppler_hz = static_cast<float>((code_m(-0.5) - code_m(0.5)) / wavelength_m);
    raw.carrier_to_noise_dbhz = 45;
    raw.lock_s = 10;
    return raw;
}

inline bool is_visible(const KeplerEphemeris& e, const Truth& truth, const GpsTime& received) {
    return way(e, truth, received, 0).elevation_rad > 0.1;
}

/// Of all satellites above 5.7 degrees, in the order of satellites().
inline std::vector<GnssRaw> epoch(const Truth& truth, const GpsTime& received) {
    std::vector<GnssRaw> raws;
    for (const auto& e : satellites())
        if (is_visible(e, truth, received)) raws.push_back(observe(e, truth, received));
    return raws;
}

} // namespace locus::gnss::synthetic
