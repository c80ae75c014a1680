#include "fusion/inertial/strapdown.h"

#include "fusion/geometry/rotation.h"
#include "fusion/units.h"

namespace locus::inertial {
namespace {

const Eigen::Vector3d gravity_mps2(0, 0, -standard_gravity_mps2);

constexpr int at(int axis, int order) { return 3 * axis + order; }

/// Puts a 3 x 3 block between the numbers `row_order` and `column_order` of the axes.
void put(ErrorTransition& f, int row_order, int column_order, const Eigen::Matrix3d& block) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) f(at(i, row_order), at(j, column_order)) = block(i, j);
}
void put_bias(ErrorTransition& f, int row_order, int bias_at, const Eigen::Matrix3d& block) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) f(at(i, row_order), bias_at + j) = block(i, j);
}

} // namespace

void move(Motion& motion, const Rates& unbiased, double dt_s) noexcept {
    // The body turns during the step: the force acts, on average, from half way.
    const Eigen::Quaterniond half_way = motion.body_to_site * rotation(0.5 * dt_s * unbiased.angular_rate_radps);
    const Eigen::Vector3d acceleration = half_way * unbiased.specific_force_mps2 + gravity_mps2;
    motion.position_site_m += dt_s * (motion.velocity_site_mps + 0.5 * dt_s * acceleration);
    motion.velocity_site_mps += dt_s * acceleration;
    motion.body_to_site = (motion.body_to_site * rotation(dt_s * unbiased.angular_rate_radps)).normalized();
}

void catch_up(Motion& motion, const HeldImu::Lag& lag) noexcept {
    const Eigen::Vector3d change = motion.body_to_site * lag.difference.specific_force_mps2;
    motion.position_site_m += lag.held_s * lag.held_s / 6 * change;
    motion.velocity_site_mps += lag.held_s / 2 * change;
    motion.body_to_site =
        (motion.body_to_site * rotation(lag.held_s / 2 * lag.difference.angular_rate_radps)).normalized();
}

ErrorTransition error_transition(const Motion& motion, const Rates& unbiased, double dt_s) noexcept {
    const Eigen::Matrix3d to_site = motion.body_to_site.toRotationMatrix();
    const Eigen::Matrix3d tilt = -skew(to_site * unbiased.specific_force_mps2);
    ErrorTransition f = ErrorTransition::Identity();
    for (int i = 0; i < 3; ++i) f(at(i, 0), at(i, 1)) = dt_s;
    put(f, 0, 2, 0.5 * dt_s * dt_s * tilt);
    put(f, 1, 2, dt_s * tilt);
    put_bias(f, 0, accelerometer_bias_at, -0.5 * dt_s * dt_s * to_site);
    put_bias(f, 1, accelerometer_bias_at, -dt_s * to_site);
    put_bias(f, 2, gyroscope_bias_at, -dt_s * to_site);
    return f;
}

ErrorTransition error_noise(const ImuNoise& noise, double dt_s) noexcept {
    const auto variance = [dt_s](double density) { return density * density * dt_s; };
    const double v = variance(noise.acceleration_mps2_rthz);
    ErrorTransition q = ErrorTransition::Zero();
    for (int i = 0; i < 3; ++i) {
        q(at(i, 0), at(i, 0)) = v * dt_s * dt_s / 3;
        q(at(i, 0), at(i, 1)) = q(at(i, 1), at(i, 0)) = v * dt_s / 2;
        q(at(i, 1), at(i, 1)) = v;
        q(at(i, 2), at(i, 2)) = variance(noise.angular_rate_radps_rthz);
        q(accelerometer_bias_at + i, accelerometer_bias_at + i) = variance(noise.acceleration_bias_walk_mps2_rts);
        q(gyroscope_bias_at + i, gyroscope_bias_at + i) = variance(noise.angular_rate_bias_walk_radps_rts);
    }
    return q;
}

} // namespace locus::inertial
