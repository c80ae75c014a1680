#include "fusion/estimators/gnss_ins_observations.h"

#include "fusion/estimators/gnss_ins_errors.h"
#include "fusion/geometry/vector.h"

#include <algorithm>
#include <cmath>

namespace locus {
namespace {

std::int32_t satellite_key(const SatelliteRange& range) { return range.constellation * 256 + range.satellite; }

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
    model.scale_sigma = s.estimate_scale ? s.scale_sigma : 0;
    model.unaided_acceleration_mps2_rthz = s.unaided_acceleration_mps2_rthz;
    model.clock_phase_m_rts = s.clock_phase_m_rts;
    model.clock_drift_mps_rts = s.clock_drift_mps_rts;
    model.align_speed_mps = s.align_speed_mps;
    model.align_heading_sigma_rad = s.align_heading_sigma_deg * rad_per_deg;
    const Eigen::AngleAxisd roll(s.mounting_deg[0] * rad_per_deg, Eigen::Vector3d::UnitX());
    const Eigen::AngleAxisd pitch(s.mounting_deg[1] * rad_per_deg, Eigen::Vector3d::UnitY());
    const Eigen::AngleAxisd yaw(s.mounting_deg[2] * rad_per_deg, Eigen::Vector3d::UnitZ());
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
double GnssInsObservations::carrier_sigma_m(const SatelliteRange& range, double elevation_sine) const noexcept {
    return settings_.carrier_sigma_m * weakness(range) / elevation_sine;
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

} // namespace locus
