// A car on a plane that touches the Earth: it stands, then drives curves at changing speed. What its inertial sensor,
// its GNSS receiver, its wheels and its UWB tag would give, with the Earth's turning and gravity in it.
#pragma once

#include "fusion/estimators/gnss_ins_settings.h"
#include "fusion/geometry/earth.h"
#include "fusion/geometry/rotation.h"
#include "fusion/inertial/ecef_strapdown.h"
#include "fusion/measurement.h"
#include "fusion/site.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace locus::test {

inline Site town() {
    Site site;
    site.origin = Wgs84Anchor{35.6676, 139.7911, 39.5, 90};
    return site;
}

struct DriveSettings {
    double force_noise_mps2_rthz = 0.02, rate_noise_radps_rthz = 3e-4;
    double force_bias_mps2 = 0.05, rate_bias_radps = 0.002; ///< sigmas that the biases are drawn with
    double scale_off = 0;                                   ///< of all six axes of the inertial sensor
    double code_sigma_m = 1, rate_sigma_mps = 0.05;
    double carrier_sigma_m = 0; ///< 0: there is no carrier
    double clock_phase_m_rts = 0.1, clock_drift_mps_rts = 0.2;
    double imu_hz = 100;
    double still_until_s = 4;
    double sensor_yaw_rad = 0; ///< how the sensor is turned in the car, which nobody tells the filter
    double pace = 1;           ///< over that of a car
    double antennas_deg = 0;   ///< where the second GNSS antenna lies: counter-clockwise from ahead
    std::size_t satellites = 9;
};

class SimulatedDrive {
  public:
    SimulatedDrive(const Site& site, const DriveSettings& settings, unsigned seed)
        : earth_(site.origin.value_or(Wgs84Anchor{})), settings_(settings), random_(seed) {
        for (int i = 0; i < 3; ++i) {
            force_bias_(i) = settings.force_bias_mps2 * draw();
            rate_bias_(i) = settings.rate_bias_radps * draw();
        }
        clock_offset_m_ = 1e5 * draw();
        clock_drift_mps_ = 100 * draw();
    }

    double time_s() const { return t_; }
    /// On by one inertial sample.
    void move() {
        constexpr int parts = 10;
        const double dt = 1 / settings_.imu_hz / parts;
        for (int i = 0; i < parts; ++i) {
            const double middle = t_ + dt / 2;
            position_site_ += dt * speed(middle) * direction(middle);
            t_ += dt;
        }
        const double step = 1 / settings_.imu_hz;
        clock_offset_m_ += step * clock_drift_mps_ + settings_.clock_phase_m_rts * std::sqrt(step) * draw();
        clock_drift_mps_ += settings_.clock_drift_mps_rts * std::sqrt(step) * draw();
    }

    const Eigen::Vector3d& position_site_m() const { return position_site_; }
    Eigen::Vector3d velocity_site_mps() const { return speed(t_) * direction(t_); }
    double speed_mps() const { return speed(t_); }
    inertial::EcefMotion motion() const {
        const Eigen::AngleAxisd turn(heading(t_) + settings_.sensor_yaw_rad, Eigen::Vector3d::UnitZ());
        return {earth_.ecef_m(position_site_), earth_.to_ecef() * velocity_site_mps(),
                Eigen::Quaterniond(earth_.to_ecef() * turn.toRotationMatrix())};
    }
    const Eigen::Vector3d& force_bias_mps2() const { return force_bias_; }
    const Eigen::Vector3d& rate_bias_radps() const { return rate_bias_; }
    double clock_offset_m() const { return clock_offset_m_; }
    double clock_drift_mps() const { return clock_drift_mps_; }
    void set_clock(double jump_m) { clock_offset_m_ += jump_m; }

    ImuSample exact_imu() const {
        const inertial::EcefMotion now = motion();
        const Eigen::Vector3d turn(0, 0, earth_rate_radps);
        const Eigen::Vector3d acceleration =
            earth_.to_ecef() * ((speed(t_ + h) * direction(t_ + h) - speed(t_ - h) * direction(t_ - h)) / (2 * h));
        const Eigen::Vector3d force =
            now.body_to_ecef.conjugate() *
            (acceleration - gravity_ecef_mps2(now.position_ecef_m) + 2 * turn.cross(now.velocity_ecef_mps));
        const double yaw = (heading(t_ + h) - heading(t_ - h)) / (2 * h);
        const Eigen::Vector3d rate = yaw * Eigen::Vector3d::UnitZ() + now.body_to_ecef.conjugate() * turn;
        ImuSample sample;
        sample.tag = address(1);
        for (int i = 0; i < 3; ++i) {
            sample.specific_force_mps2[static_cast<std::size_t>(i)] = force(i);
            sample.angular_rate_radps[static_cast<std::size_t>(i)] = rate(i);
        }
        return sample;
    }
    Measurement imu() {
        ImuSample sample = exact_imu();
        const double root_hz = std::sqrt(settings_.imu_hz);
        for (std::size_t i = 0; i < 3; ++i) {
            const auto axis = static_cast<Eigen::Index>(i);
            sample.specific_force_mps2[i] *= 1 + settings_.scale_off;
            sample.angular_rate_radps[i] *= 1 + settings_.scale_off;
            sample.specific_force_mps2[i] += force_bias_(axis) + settings_.force_noise_mps2_rthz * root_hz * draw();
            sample.angular_rate_radps[i] += rate_bias_(axis) + settings_.rate_noise_radps_rthz * root_hz * draw();
        }
        return stamped(sample);
    }

    Eigen::Vector3d satellite_ecef_m(std::size_t i) const {
        const double azimuth = 2.4 * static_cast<double>(i), elevation = 0.35 + 0.13 * static_cast<double>(i);
        const Eigen::Vector3d sight(std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
                                    std::sin(elevation));
        return earth_.ecef_m(2.2e7 * sight) + t_ * satellite_velocity_mps(i);
    }
    Eigen::Vector3d satellite_velocity_mps(std::size_t i) const {
        const double angle = 1.1 * static_cast<double>(i);
        return {2500 * std::cos(angle), 2500 * std::sin(angle), 800};
    }
    Measurement satellite(std::size_t i) {
        const inertial::EcefMotion now = motion();
        const Eigen::Vector3d arm = satellite_ecef_m(i) - now.position_ecef_m;
        SatelliteRange range;
        range.tag = address(1);
        for (int axis = 0; axis < 3; ++axis) {
            range.satellite_ecef_m[static_cast<std::size_t>(axis)] = satellite_ecef_m(i)(axis);
            range.satellite_velocity_ecef_mps[static_cast<std::size_t>(axis)] =
                static_cast<float>(satellite_velocity_mps(i)(axis));
        }
        range.pseudorange_m = arm.norm() + clock_offset_m_ + settings_.code_sigma_m * draw();
        range.range_rate_mps =
            static_cast<float>(arm.normalized().dot(satellite_velocity_mps(i) - now.velocity_ecef_mps) +
                               clock_drift_mps_ + settings_.rate_sigma_mps * draw());
        range.sigma_m = static_cast<float>(settings_.code_sigma_m);
        range.sigma_rate_mps = static_cast<float>(settings_.rate_sigma_mps);
        range.carrier_to_noise_dbhz = 45;
        range.satellite = static_cast<std::uint8_t>(i + 1);
        if (settings_.carrier_sigma_m > 0) {
            range.carrier_m = arm.norm() + clock_offset_m_ + ambiguity_m_.at(i) + settings_.carrier_sigma_m * draw();
            range.lock_s = static_cast<float>(std::min(64.5, 20 + t_ - locked_s_.at(i))); // u-blox counts to 64.5
        }
        return stamped(range);
    }
    /// The carrier slips, which its receiver does not notice; or does.
    void slip(std::size_t i, double by_m) { ambiguity_m_.at(i) += by_m; }
    void lose_lock(std::size_t i) {
        slip(i, 1000);
        locked_s_.at(i) = t_ + 20;
    }
    Measurement fix(double sigma_m, double speed_sigma_mps) {
        const Geodetic place = geodetic(earth_.ecef_m(position_site_));
        const Eigen::Vector3d velocity = enu_to_ecef(place).transpose() * motion().velocity_ecef_mps;
        GnssFix fix;
        fix.tag = address(1);
        fix.latitude_deg = place.latitude_deg + sigma_m * draw() / 111e3;
        fix.longitude_deg = place.longitude_deg + sigma_m * draw() / 90e3;
        fix.height_ellipsoid_m = place.height_ellipsoid_m + sigma_m * draw();
        for (std::size_t i = 0; i < 3; ++i)
            fix.velocity_enu_mps[i] =
                static_cast<float>(velocity(static_cast<Eigen::Index>(i)) + speed_sigma_mps * draw());
        fix.sigma_horizontal_m = fix.sigma_vertical_m = static_cast<float>(sigma_m);
        fix.sigma_velocity_mps = static_cast<float>(speed_sigma_mps);
        fix.fix_type = gnss_fix_type::full;
        return stamped(fix);
    }
    Measurement range(const Anchor& anchor, double sigma_m) {
        const Eigen::Vector3d arm =
            position_site_ -
            Eigen::Vector3d(anchor.position_site_m[0], anchor.position_site_m[1], anchor.position_site_m[2]);
        return stamped(Range{anchor.address, address(1), arm.norm() + sigma_m * draw(), static_cast<float>(sigma_m)});
    }
    Measurement heading(double sigma_deg) {
        const double degree = std::numbers::pi / 180, antennas = settings_.antennas_deg * degree;
        const inertial::EcefMotion now = motion();
        const Eigen::Vector3d line = enu_to_ecef(geodetic(now.position_ecef_m)).transpose() *
                                     (now.body_to_ecef * Eigen::Vector3d(std::cos(antennas), std::sin(antennas), 0));
        const double told_deg = std::atan2(line.x(), line.y()) / degree + sigma_deg * draw();
        return stamped(Heading{address(1), std::fmod(told_deg + 360, 360), static_cast<float>(sigma_deg), 1});
    }
    template <class Sample>
    Measurement stamped(const Sample& sample) {
        return {timestamp_from_s(100 + t_), ++sequence_, 0, sample};
    }
    Timestamp now() const { return timestamp_from_s(100 + t_); }
    double draw() { return normal_(random_); }

  private:
    static constexpr double h = 1e-4;
    double driven_s(double t) const { return std::max(0.0, t - settings_.still_until_s); }
    double speed(double t) const {
        const double s = driven_s(t);
        return settings_.pace * (10 + 4 * std::sin(0.4 * s)) * (1 - std::exp(-s * s / 8));
    }
    double heading(double t) const { return 0.7 + 0.9 * std::sin(0.2 * driven_s(t)) * (1 - std::exp(-driven_s(t))); }
    Eigen::Vector3d direction(double t) const { return {std::cos(heading(t)), std::sin(heading(t)), 0}; }

    SiteOnEarth earth_;
    DriveSettings settings_;
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
    double t_ = 0;
    Eigen::Vector3d position_site_{0, 0, 0};
    Eigen::Vector3d force_bias_, rate_bias_;
    double clock_offset_m_ = 0, clock_drift_mps_ = 0;
    std::array<double, 16> ambiguity_m_{}, locked_s_{};
    std::uint32_t sequence_ = 0;
};

/// The noise of the simulation is Gaussian and white: then no weight, no gate and no wandering error is the optimum.
inline GnssInsSettings exact_settings() {
    GnssInsSettings settings;
    settings.robust_scale = 1e6;
    settings.gate_false_alarm = 1e-12;
    settings.satellite_error_sigma_m = 0;
    settings.acceleration_bias_sigma_mps2 = 0.05;
    settings.angular_rate_bias_sigma_radps = 0.002;
    settings.acceleration_bias_walk_mps2_rts = settings.angular_rate_bias_walk_radps_rts = 0;
    settings.non_holonomic = settings.zero_velocity = false;
    return settings;
}

} // namespace locus::test
