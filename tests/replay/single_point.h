// A position from pseudoranges and ephemerides and nothing else, as simple as can be: it proves that both are read
// right.
#pragma once

#include "fusion/gnss/satellite.h"

#include <Eigen/Dense>

#include <cmath>
#include <numbers>
#include <vector>

namespace locus::test {

inline constexpr double light_mps = 299792458;

/// WGS-84.
inline Eigen::Vector3d ecef_m(double latitude_deg, double longitude_deg, double height_m) {
    constexpr double a_m = 6378137, e2 = 6.69437999014e-3, rad = std::numbers::pi / 180;
    const double sine = std::sin(latitude_deg * rad), n_m = a_m / std::sqrt(1 - e2 * sine * sine);
    const double across_m = (n_m + height_m) * std::cos(latitude_deg * rad);
    return {across_m * std::cos(longitude_deg * rad), across_m * std::sin(longitude_deg * rad),
            (n_m * (1 - e2) + height_m) * sine};
}

/// Along the radius, which is up to a fraction of a degree.
inline double up_m(const Eigen::Vector3d& error_m, const Eigen::Vector3d& at_m) {
    return error_m.dot(at_m.normalized());
}
inline double horizontal_m(const Eigen::Vector3d& error_m, const Eigen::Vector3d& at_m) {
    return (error_m - up_m(error_m, at_m) * at_m.normalized()).norm();
}

struct Ray {
    Eigen::Vector3d satellite_m; ///< in the Earth's frame of the moment of reception
    double range_m;              ///< with the satellite's clock taken off
    int clock;                   ///< column of the receiver's clock in the equations: 3 or 4
};

/// `delay_s`: group delay that the satellite's clock does not count.
inline Ray ray_of(const gnss::KeplerEphemeris& e, const gnss::GpsTime& received, double pseudorange_m, double delay_s,
                  int clock) {
    constexpr double earth_rate_radps = 7.2921151467e-5;
    const double travel_s = pseudorange_m / light_mps;
    const double clock_s = gnss::satellite_state(e, received + -travel_s).clock_s - delay_s;
    const auto state = gnss::satellite_state(e, received + (-travel_s - clock_s));
    const Eigen::AngleAxisd turn(-earth_rate_radps * travel_s, Eigen::Vector3d::UnitZ());
    return {turn * Eigen::Vector3d(state.position_ecef_m.data()), pseudorange_m + clock_s * light_mps, clock};
}

inline double sine_of_elevation(const Eigen::Vector3d& at_m, const Eigen::Vector3d& satellite_m) {
    return at_m.norm() < 6e6 ? 1 : (satellite_m - at_m).normalized().dot(at_m.normalized());
}

/// 2.4 m upwards through the troposphere, longer the flatter.
inline double troposphere_m(const Eigen::Vector3d& at_m, const Eigen::Vector3d& satellite_m) {
    return at_m.norm() < 6e6 ? 0 : 2.4 / std::max(0.1, sine_of_elevation(at_m, satellite_m));
}

/// As rtklib weighs: one part of the error is the same everywhere, another grows towards the horizon.
inline double weight(const Eigen::Vector3d& at_m, const Eigen::Vector3d& satellite_m) {
    const double sine = std::max(0.1, sine_of_elevation(at_m, satellite_m));
    return 1 / std::hypot(1, 1 / sine);
}

/// Least squares; a clock that no ray has stays 0.
inline Eigen::Vector3d position_m(const std::vector<Ray>& rays) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(5);
    for (int round = 0; round < 10; ++round) {
        Eigen::MatrixXd a = Eigen::MatrixXd::Zero(static_cast<int>(rays.size()), 5);
        Eigen::VectorXd b(static_cast<int>(rays.size()));
        for (int i = 0; i < b.size(); ++i) {
            const Ray& ray = rays[static_cast<std::size_t>(i)];
            const Eigen::Vector3d at_m = x.head<3>(), way_m = ray.satellite_m - at_m;
            a.row(i).head<3>() = -way_m.normalized();
            a(i, ray.clock) = 1;
            b[i] = ray.range_m - troposphere_m(at_m, ray.satellite_m) - way_m.norm() - x[ray.clock];
            a.row(i) *= weight(at_m, ray.satellite_m);
            b[i] *= weight(at_m, ray.satellite_m);
        }
        x += a.completeOrthogonalDecomposition().solve(b);
    }
    return x.head<3>();
}

} // namespace locus::test
