// What a vehicle's track expects of the vehicle itself: wheels, constraints, standstill, barometer.
#include "fusion/estimators/gnss_ins_errors.h"
#include "fusion/estimators/gnss_ins_observations.h"

#include <cmath>

namespace locus {
namespace {

/// Before the barometer is set to the height it may be anywhere on the Earth's surface.
constexpr double pressure_offset_sigma_m = 1000;
constexpr double pressure_offset_known_m = 10;

constexpr double standing_sigma_mps = 0.02;         ///< an idling engine shakes a car
constexpr double standing_rate_sigma_radps = 0.002; ///< the same, of ten samples a second

/// International standard atmosphere (ISO 2533), m over sea level at 1013.25 hPa.
double standard_height_m(double pressure_pa) { return 44330.77 * (1 - std::pow(pressure_pa / 101325, 0.190263)); }

} // namespace

// ---- the vehicle

GnssInsObservations::Axle GnssInsObservations::axle(GnssInsTrack& track) const noexcept {
    const filter::WanderModel off{settings_.mounting_sigma_deg * rad_per_deg, no_limit};
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
    if (const int scales = track.scales_at(); scales >= 0)
        scalar.jacobian(scales + 5) = -track.angular_rate_radps().z();
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
