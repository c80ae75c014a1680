#include "fusion/estimators/gnss_ins_observations.h"

#include "fusion/geometry/rotation.h"
#include "fusion/geometry/vector.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace locus {
namespace {

using GnssInsRow = GnssInsTrack::Vector;

constexpr double radian_per_degree = std::numbers::pi / 180;

/// Names of the wandering errors. Satellites are called by constellation and number, all else below zero.
constexpr std::int32_t wheel_scale_error = -1, mounting_yaw_error = -2, mounting_pitch_error = -3, pressure_offset = -4,
                       pressure_weather = -5, fix_error = -10, constellation_clock = -20, anchor_error = -1000;

/// Clocks of two constellations are known to each other within this: 300 ns and the receiver's own delays.
constexpr double constellation_clock_sigma_m = 300;
/// Before the barometer is set to the height it may be anywhere on the Earth's surface.
constexpr double pressure_offset_sigma_m = 1000;
constexpr double pressure_offset_known_m = 10;

constexpr double standing_sigma_mps = 0.02;         ///< an idling engine shakes a car
constexpr double standing_rate_sigma_radps = 0.002; ///< the same, of ten samples a second

std::int32_t satellite_key(const SatelliteRange& range) { return range.constellation * 256 + range.satellite; }

double stated_or(float sigma, double otherwise) {
    return std::isfinite(sigma) && sigma > 0 ? double{sigma} : otherwise;
}

double own_square(double x) { return x * x; }

GnssInsRow blank_row(const GnssInsTrack& track) { return GnssInsRow::Zero(track.size()); }

/// What weaker signals add to the noise.
double weakness(const SatelliteRange& range) {
    constexpr float strong_dbhz = 45;
    if (!std::isfinite(range.carrier_to_noise_dbhz) || range.carrier_to_noise_dbhz > strong_dbhz) return 1;
    return std::pow(10.0, double{strong_dbhz - range.carrier_to_noise_dbhz} / 20);
}

Eigen::Vector3d velocity_of(const SatelliteRange& range) {
    const Vec3f& v = range.satellite_velocity_ecef_mps;
    return {double{v[0]}, double{v[1]}, double{v[2]}};
}

/// International standard atmosphere (ISO 2533), m over sea level at 1013.25 hPa.
double standard_height_m(double pressure_pa) { return 44330.77 * (1 - std::pow(pressure_pa / 101325, 0.190263)); }

} // namespace

GnssInsObservations::GnssInsObservations(const Site& site, const GnssInsSettings& settings)
    : settings_(settings), earth_(site.origin.value_or(Wgs84Anchor{})),
      antenna_body_m_(vector(settings.gnss_antenna_body_m)), tag_body_m_(vector(settings.tag_body_m)),
      axle_body_m_(vector(settings.axle_body_m)) {}

GnssInsMotionModel GnssInsObservations::motion_model() const noexcept {
    const GnssInsSettings& s = settings_;
    GnssInsMotionModel model;
    model.imu = {s.acceleration_noise_mps2_rthz, s.angular_rate_noise_radps_rthz, s.acceleration_bias_walk_mps2_rts,
                 s.angular_rate_bias_walk_radps_rts};
    model.acceleration_bias_sigma_mps2 = s.acceleration_bias_sigma_mps2;
    model.angular_rate_bias_sigma_radps = s.angular_rate_bias_sigma_radps;
    model.unaided_acceleration_mps2_rthz = s.unaided_acceleration_mps2_rthz;
    model.clock_phase_m_rts = s.clock_phase_m_rts;
    model.clock_drift_mps_rts = s.clock_drift_mps_rts;
    model.align_speed_mps = s.align_speed_mps;
    model.align_heading_sigma_rad = s.align_heading_sigma_deg * radian_per_degree;
    const Eigen::AngleAxisd roll(s.mounting_deg[0] * radian_per_degree, Eigen::Vector3d::UnitX());
    const Eigen::AngleAxisd pitch(s.mounting_deg[1] * radian_per_degree, Eigen::Vector3d::UnitY());
    const Eigen::AngleAxisd yaw(s.mounting_deg[2] * radian_per_degree, Eigen::Vector3d::UnitZ());
    model.sensor_to_body = yaw * pitch * roll;
    model.antenna_body_m = antenna_body_m_;
    return model;
}

// ---- satellites

double GnssInsObservations::elevation_sine(const GnssInsTrack& track, const SatelliteRange& range) const noexcept {
    const Eigen::Vector3d place = track.position_m();
    return (vector(range.satellite_ecef_m) - place).normalized().dot(place.normalized());
}

double GnssInsObservations::code_sigma_m(const SatelliteRange& range, double elevation_sine) const noexcept {
    return stated_or(range.sigma_m, settings_.code_sigma_m * weakness(range) / elevation_sine);
}
double GnssInsObservations::rate_sigma_mps(const SatelliteRange& range, double elevation_sine) const noexcept {
    return stated_or(range.sigma_rate_mps, settings_.rate_sigma_mps * weakness(range) / elevation_sine);
}
double GnssInsObservations::satellite_error_sigma_m(double elevation_sine) const noexcept {
    return settings_.satellite_error_sigma_m / elevation_sine;
}

GnssInsScalar GnssInsObservations::pseudorange(GnssInsTrack& track, const SatelliteRange& range) const noexcept {
    const double sine = elevation_sine(track, range);
    const bool own_clock = range.constellation != constellation::gps && range.constellation != constellation::qzss;
    const int error_at =
        track.wanderer(satellite_key(range), {satellite_error_sigma_m(sine), settings_.satellite_error_time_s});
    const int clock_at =
        own_clock ? track.wanderer(constellation_clock - range.constellation, {constellation_clock_sigma_m, no_limit})
                  : -1;
    const Eigen::Vector3d arm = vector(range.satellite_ecef_m) - track.point_ecef_m(antenna_body_m_);
    GnssInsScalar scalar{blank_row(track)};
    track.spread_position(-arm.normalized(), antenna_body_m_, scalar.jacobian);
    scalar.jacobian(clock_offset_at) = scalar.jacobian(error_at) = 1;
    double expected_m = arm.norm() + track.state(clock_offset_at) + track.state(error_at);
    if (own_clock) {
        scalar.jacobian(clock_at) = 1;
        expected_m += track.state(clock_at);
    }
    scalar.innovation = range.pseudorange_m - expected_m;
    scalar.variance = own_square(code_sigma_m(range, sine));
    return scalar;
}

GnssInsScalar GnssInsObservations::range_rate(const GnssInsTrack& track, const SatelliteRange& range) const noexcept {
    const Eigen::Vector3d arm = vector(range.satellite_ecef_m) - track.point_ecef_m(antenna_body_m_);
    const Eigen::Vector3d sight = arm.normalized();
    const Eigen::Vector3d relative = velocity_of(range) - track.point_velocity_ecef_mps(antenna_body_m_);
    GnssInsScalar scalar{blank_row(track)};
    const double rate_mps = sight.dot(relative);
    track.spread_velocity(-sight, antenna_body_m_, scalar.jacobian);
    track.spread_position(-(relative - rate_mps * sight) / arm.norm(), antenna_body_m_, scalar.jacobian);
    scalar.jacobian(clock_drift_at) = 1;
    scalar.innovation = double{range.range_rate_mps} - rate_mps - track.state(clock_drift_at);
    scalar.variance = own_square(rate_sigma_mps(range, elevation_sine(track, range)));
    return scalar;
}

// ---- fixes

GnssInsScalar GnssInsObservations::fix_position(GnssInsTrack& track, const GnssFix& fix, int axis) const noexcept {
    const int error_at = track.wanderer(fix_error - axis, {settings_.fix_error_sigma_m, settings_.fix_error_time_s});
    const Geodetic place{fix.latitude_deg, fix.longitude_deg, fix.height_ellipsoid_m};
    const Eigen::Vector3d direction = enu_to_ecef(place).col(axis);
    GnssInsScalar scalar{blank_row(track)};
    track.spread_position(direction, antenna_body_m_, scalar.jacobian);
    scalar.jacobian(error_at) = 1;
    scalar.innovation = direction.dot(ecef_m(place) - track.point_ecef_m(antenna_body_m_)) - track.state(error_at);
    const float sigma_m = axis < 2 ? fix.sigma_horizontal_m : fix.sigma_vertical_m;
    scalar.variance = own_square(stated_or(sigma_m, settings_.fix_sigma_m));
    return scalar;
}

GnssInsScalar GnssInsObservations::fix_velocity(const GnssInsTrack& track, const GnssFix& fix,
                                                int axis) const noexcept {
    const Geodetic place{fix.latitude_deg, fix.longitude_deg, fix.height_ellipsoid_m};
    const Eigen::Vector3d direction = enu_to_ecef(place).col(axis);
    GnssInsScalar scalar{blank_row(track)};
    track.spread_velocity(direction, antenna_body_m_, scalar.jacobian);
    const auto told_mps = double{fix.velocity_enu_mps[static_cast<std::size_t>(axis)]};
    scalar.innovation = told_mps - direction.dot(track.point_velocity_ecef_mps(antenna_body_m_));
    scalar.variance = own_square(stated_or(fix.sigma_velocity_mps, settings_.fix_speed_sigma_mps));
    return scalar;
}

GnssInsScalar GnssInsObservations::range(GnssInsTrack& track, const Range& range, const Anchor& anchor) const noexcept {
    const auto key = anchor_error - static_cast<std::int32_t>(number(anchor.address) % 1'000'000);
    const int error_at = track.wanderer(key, {settings_.range_error_sigma_m, settings_.range_error_time_s});
    const Eigen::Vector3d arm = track.point_ecef_m(tag_body_m_) - earth_.ecef_m(vector(anchor.position_site_m));
    GnssInsScalar scalar{blank_row(track)};
    track.spread_position(arm.normalized(), tag_body_m_, scalar.jacobian);
    scalar.jacobian(error_at) = 1;
    scalar.innovation = range.range_m - anchor.range_bias_m - arm.norm() - track.state(error_at);
    scalar.variance =
        own_square(stated_or(range.sigma_m, std::isfinite(anchor.sigma_m) ? anchor.sigma_m : settings_.range_sigma_m));
    return scalar;
}

// ---- the vehicle

GnssInsObservations::Axle GnssInsObservations::axle(GnssInsTrack& track) const noexcept {
    const filter::WanderModel off{settings_.mounting_sigma_deg * radian_per_degree, no_limit};
    Axle axle;
    axle.yaw_at = track.wanderer(mounting_yaw_error, off);
    axle.pitch_at = track.wanderer(mounting_pitch_error, off);
    axle.yaw_off_rad = track.state(axle.yaw_at);
    axle.pitch_off_rad = track.state(axle.pitch_at);
    axle.velocity_body_mps = track.body_to_ecef().conjugate() * track.point_velocity_ecef_mps(axle_body_m_);
    return axle;
}

/// `gradient_body`: of the observation by the axle's velocity in the body's axes.
void GnssInsObservations::spread_axle(const GnssInsTrack& track, const Eigen::Vector3d& gradient_body,
                                      GnssInsRow& jacobian) const noexcept {
    const Eigen::Vector3d gradient = track.body_to_ecef() * gradient_body;
    const Eigen::Vector3d by_attitude = gradient.cross(track.velocity_ecef_mps());
    const Eigen::Vector3d by_bias = gradient_body.cross(axle_body_m_);
    for (int axis = 0; axis < 3; ++axis) {
        jacobian(GnssInsTrack::place(axis, 1)) += gradient(axis);
        jacobian(GnssInsTrack::place(axis, 2)) += by_attitude(axis);
        jacobian(inertial::gyroscope_bias_at + axis) += by_bias(axis);
    }
}

GnssInsScalar GnssInsObservations::wheel_speed(GnssInsTrack& track, const WheelSpeed& wheel) const noexcept {
    const int scale_at = track.wanderer(wheel_scale_error, {settings_.wheel_scale_sigma, no_limit});
    const double forward_mps = (track.body_to_ecef().conjugate() * track.point_velocity_ecef_mps(axle_body_m_)).x();
    const bool backwards_untold = wheel.speed_mps >= 0 && forward_mps < 0;
    const double scale = (backwards_untold ? -1 : 1) * (1 + track.state(scale_at));
    GnssInsScalar scalar{blank_row(track)};
    spread_axle(track, scale * Eigen::Vector3d::UnitX(), scalar.jacobian);
    scalar.jacobian(scale_at) = std::abs(forward_mps);
    scalar.innovation = wheel.speed_mps - scale * forward_mps;
    scalar.variance = own_square(stated_or(wheel.sigma_mps, settings_.wheel_speed_sigma_mps));
    return scalar;
}

GnssInsScalar GnssInsObservations::yaw_rate(const GnssInsTrack& track, const WheelSpeed& wheel) const noexcept {
    GnssInsScalar scalar{blank_row(track)};
    scalar.jacobian(inertial::gyroscope_bias_at + 2) = -1;
    scalar.innovation = double{wheel.yaw_rate_radps} - track.angular_rate_radps().z();
    scalar.variance = own_square(settings_.yaw_rate_sigma_radps);
    return scalar;
}

GnssInsScalar GnssInsObservations::slip(GnssInsTrack& track, int axis) const noexcept {
    const Axle now = axle(track);
    const double off_rad = axis == 1 ? now.yaw_off_rad : now.pitch_off_rad;
    GnssInsScalar scalar{blank_row(track)};
    spread_axle(track, Eigen::Vector3d::Unit(axis) - off_rad * Eigen::Vector3d::UnitX(), scalar.jacobian);
    scalar.jacobian(axis == 1 ? now.yaw_at : now.pitch_at) = -now.velocity_body_mps.x();
    scalar.innovation = off_rad * now.velocity_body_mps.x() - now.velocity_body_mps(axis);
    scalar.variance = own_square(settings_.slip_sigma_mps);
    return scalar;
}

GnssInsScalar GnssInsObservations::standing(const GnssInsTrack& track, int axis) const noexcept {
    GnssInsScalar scalar{blank_row(track)};
    scalar.jacobian(GnssInsTrack::place(axis, 1)) = 1;
    scalar.innovation = -track.velocity_ecef_mps()(axis);
    scalar.variance = own_square(standing_sigma_mps);
    return scalar;
}

GnssInsScalar GnssInsObservations::standing_rate(const GnssInsTrack& track, int axis) const noexcept {
    GnssInsScalar scalar{blank_row(track)};
    scalar.jacobian(inertial::gyroscope_bias_at + axis) = 1;
    double expected = track.state(inertial::gyroscope_bias_at + axis);
    if (track.is_inertial()) {
        const Eigen::Vector3d turn(0, 0, earth_rate_radps);
        const Eigen::Vector3d direction = track.body_to_ecef() * Eigen::Vector3d::Unit(axis);
        const Eigen::Vector3d by_attitude = direction.cross(turn);
        for (int i = 0; i < 3; ++i) scalar.jacobian(GnssInsTrack::place(i, 2)) = by_attitude(i);
        expected += direction.dot(turn);
    }
    scalar.innovation = track.measured_rate_radps()(axis) - expected;
    scalar.variance = own_square(standing_rate_sigma_radps);
    return scalar;
}

// ---- barometer

GnssInsScalar GnssInsObservations::pressure(GnssInsTrack& track, const Pressure& pressure) const noexcept {
    const int offset_at = track.wanderer(pressure_offset, {pressure_offset_sigma_m, no_limit});
    const int weather_at =
        track.wanderer(pressure_weather, {settings_.pressure_error_sigma_m, settings_.pressure_error_time_s});
    const Geodetic place = geodetic(track.position_m());
    GnssInsScalar scalar{blank_row(track)};
    track.spread_position(enu_to_ecef(place).col(2), Eigen::Vector3d::Zero(), scalar.jacobian);
    scalar.jacobian(offset_at) = scalar.jacobian(weather_at) = 1;
    scalar.innovation = standard_height_m(pressure.pressure_pa) - place.height_ellipsoid_m - track.state(offset_at) -
                        track.state(weather_at);
    scalar.variance = own_square(settings_.pressure_height_sigma_m);
    return scalar;
}

std::optional<double> GnssInsObservations::height_by_pressure_m(GnssInsTrack& track,
                                                                const Pressure& pressure) const noexcept {
    const int offset_at = track.wanderer(pressure_offset, {pressure_offset_sigma_m, no_limit});
    const int weather_at =
        track.wanderer(pressure_weather, {settings_.pressure_error_sigma_m, settings_.pressure_error_time_s});
    const double variance = track.covariance(offset_at, offset_at) + track.covariance(weather_at, weather_at) +
                            2 * track.covariance(offset_at, weather_at);
    if (variance > own_square(pressure_offset_known_m)) return std::nullopt;
    return standard_height_m(pressure.pressure_pa) - track.state(offset_at) - track.state(weather_at);
}

} // namespace locus
