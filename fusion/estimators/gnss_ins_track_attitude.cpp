// How a vehicle's track comes to its attitude, and loses it: the sensor levels itself, a course or the heading of two
// antennas says where it points, and a sensor that falls silent takes it all away.
#include "fusion/estimators/gnss_ins_errors.h"
#include "fusion/estimators/gnss_ins_track.h"
#include "fusion/geometry/earth.h"
#include "fusion/geometry/rotation.h"
#include "fusion/geometry/vector.h"

#include <cmath>

namespace locus {
namespace {

/// A course known better than this makes a heading: the filter aligns from 20 degrees off.
constexpr double worst_course_sigma_rad = 0.2;

} // namespace

void GnssInsTrack::sense(const ImuSample& sample, Timestamp time, bool started) noexcept {
    const inertial::Rates held = unbiased();
    const Eigen::Vector3d force = model_.sensor_to_body * vector(sample.specific_force_mps2);
    const Eigen::Vector3d rate = model_.sensor_to_body * vector(sample.angular_rate_radps);
    ImuSample turned = sample;
    turned.specific_force_mps2 = {force.x(), force.y(), force.z()};
    turned.angular_rate_radps = {rate.x(), rate.y(), rate.z()};
    const auto lag = imu_.take(turned, time);
    if (started) ask_for_scales();
    since_imu_s_ = 0;
    sensed_ = true;
    if (!lag) {
        levelling_.forget();
        rest_.forget();
        return;
    }
    rest_.carry(imu_.rates(), lag->held_s);
    if (inertial_) {
        inertial::EcefMotion now = motion();
        inertial::catch_up(now, held, *lag);
        set_motion(now);
        return;
    }
    levelling_.carry(unbiased(), lag->held_s);
    if (started && levelling_.is_level()) begin_inertial_if_fast();
}

/// A course on the level and how unsure it is: by the velocity across it.
GnssInsTrack::Course GnssInsTrack::course() const noexcept {
    const Eigen::Vector3d up = position_m().normalized();
    const Eigen::Vector3d level = velocity_ecef_mps() - up.dot(velocity_ecef_mps()) * up;
    const Eigen::Vector3d across = up.cross(level.normalized());
    double variance = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) variance += across(i) * covariance(place(i, 1), place(j, 1)) * across(j);
    return {level, std::sqrt(variance) / level.norm()};
}

void GnssInsTrack::begin_inertial_if_fast() noexcept {
    const Course now = course();
    if (now.velocity_ecef_mps.norm() < model_.align_speed_mps || now.sigma_rad > worst_course_sigma_rad) return;
    begin_inertial(now.velocity_ecef_mps, std::hypot(model_.align_heading_sigma_rad, now.sigma_rad));
}

void GnssInsTrack::begin_inertial(const Eigen::Vector3d& course_ecef, double heading_sigma_rad) noexcept {
    const Eigen::Vector3d course = enu_to_ecef(geodetic(position_m())).transpose() * course_ecef;
    begin_inertial(std::atan2(course.y(), course.x()), course.norm(), heading_sigma_rad);
}

bool GnssInsTrack::begin_inertial_towards(double forward_from_east_rad, double heading_sigma_rad) noexcept {
    if (!sensed_ || !levelling_.is_level()) return false;
    begin_inertial(forward_from_east_rad, velocity_ecef_mps().norm(), heading_sigma_rad);
    return true;
}

void GnssInsTrack::begin_inertial(double forward_from_east_rad, double speed_mps, double heading_sigma_rad) noexcept {
    const Eigen::Matrix3d enu = enu_to_ecef(geodetic(position_m()));
    const double turn = forward_from_east_rad - heading_rad(levelling_.body_to_level());
    const Eigen::Quaterniond heading(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()));
    body_to_ecef_ = (Eigen::Quaterniond(enu) * heading * levelling_.body_to_level()).normalized();
    const double tilt = levelling_.tilt_sigma_rad(speed_mps, model_.acceleration_bias_sigma_mps2);
    const Eigen::Vector3d variances(own_square(tilt), own_square(tilt), own_square(heading_sigma_rad));
    const Eigen::Matrix3d attitude = enu * variances.asDiagonal() * enu.transpose();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j)
            covariance(place(i, 2), place(j, 2)) = covariance(place(j, 2), place(i, 2)) = attitude(i, j);
    const Eigen::Vector3d lever = body_to_ecef_ * model_.antenna_body_m;
    for (int axis = 0; axis < 3; ++axis) state(place(axis, 0)) -= lever(axis);
    inertial_ = true;
}

void GnssInsTrack::fall_back() noexcept {
    const Eigen::Vector3d antenna_m = point_ecef_m(model_.antenna_body_m);
    for (int axis = 0; axis < 3; ++axis) {
        state(place(axis, 0)) = antenna_m(axis);
        covariance.row(place(axis, 2)).setZero();
        covariance.col(place(axis, 2)).setZero();
    }
    inertial_ = false;
    levelling_.forget();
    rest_.forget();
}

} // namespace locus
