// A target on a smooth path that turns, climbs and tilts, with the ranges and inertial samples that it would give.
#pragma once

#include "fusion/geometry/rotation.h"
#include "fusion/geometry/vector.h"
#include "fusion/measurement.h"
#include "fusion/site.h"
#include "fusion/units.h"

#include <Eigen/Dense>

#include <cmath>
#include <random>

namespace locus::test {

struct FlightSettings {
    double range_sigma_m = 0.1;
    double force_noise_mps2_rthz = 0.05;
    double rate_noise_radps_rthz = 0.002;
    Eigen::Vector3d force_bias_mps2{0.1, -0.15, 0.05};
    Eigen::Vector3d rate_bias_radps{0.004, -0.003, 0.005};
    double imu_hz = 100;
    double still_until_s = 2;
    double mounted_heading_rad = 2.3; ///< of the body's x axis at the start
};

class SimulatedFlight {
  public:
    SimulatedFlight(const Site& site, const FlightSettings& settings, unsigned seed)
        : site_(site), settings_(settings), random_(seed) {}

    /// Sums of sines, at rest with all its derivatives until `still_until_s`.
    static Eigen::Vector3d path_m(double phase) {
        return {2.0 * std::sin(0.8 * phase), 1.6 * std::sin(0.6 * phase), 1.5 + 0.5 * std::sin(0.5 * phase)};
    }
    Eigen::Vector3d position_m(double t) const { return path_m(phase(t)); }
    Eigen::Vector3d velocity_mps(double t) const { return (position_m(t + h) - position_m(t - h)) / (2 * h); }
    Eigen::Vector3d acceleration_mps2(double t) const {
        return (position_m(t + h) - 2 * position_m(t) + position_m(t - h)) / (h * h);
    }
    Eigen::Quaterniond body_to_site(double t) const {
        const double u = phase(t);
        const Eigen::AngleAxisd heading(settings_.mounted_heading_rad + 0.5 * std::sin(0.4 * u),
                                        Eigen::Vector3d::UnitZ());
        const Eigen::AngleAxisd pitch(0.15 * std::sin(0.9 * u), Eigen::Vector3d::UnitY());
        const Eigen::AngleAxisd roll(0.1 * std::sin(1.1 * u), Eigen::Vector3d::UnitX());
        return Eigen::Quaterniond(heading * pitch * roll);
    }

    Measurement imu(double t) { return {timestamp_from_s(t), ++sequence_, 1, imu_sample(t)}; }
    ImuSample imu_sample(double t) {
        const double root_hz = std::sqrt(settings_.imu_hz);
        const Eigen::Quaterniond to_body = body_to_site(t).conjugate();
        const Eigen::Vector3d up(0, 0, standard_gravity_mps2);
        const Eigen::Vector3d force = to_body * (acceleration_mps2(t) + up) + settings_.force_bias_mps2 +
                                      settings_.force_noise_mps2_rthz * root_hz * draw3();
        const Eigen::AngleAxisd turn(body_to_site(t - h).conjugate() * body_to_site(t + h));
        const Eigen::Vector3d rate = turn.angle() / (2 * h) * turn.axis() + settings_.rate_bias_radps +
                                     settings_.rate_noise_radps_rthz * root_hz * draw3();
        ImuSample sample;
        sample.tag = address(9);
        sample.specific_force_mps2 = {force.x(), force.y(), force.z()};
        sample.angular_rate_radps = {rate.x(), rate.y(), rate.z()};
        return sample;
    }
    Measurement range(std::size_t anchor, double t) {
        const double true_m = (position_m(t) - vector(site_.anchors[anchor].position_site_m)).norm();
        return {timestamp_from_s(t), ++sequence_, 0,
                Range{site_.anchors[anchor].address, address(9), true_m + settings_.range_sigma_m * draw()}};
    }
    double draw() { return normal_(random_); }

  private:
    static constexpr double h = 1e-4;
    /// Starts to run smoothly after the rest.
    double phase(double t) const {
        const double moved_s = std::max(0.0, t - settings_.still_until_s);
        return moved_s - std::tanh(moved_s);
    }
    Eigen::Vector3d draw3() { return {draw(), draw(), draw()}; }

    const Site& site_;
    FlightSettings settings_;
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
    std::uint32_t sequence_ = 0;
};

} // namespace locus::test
