#include "fusion/inertial/ecef_strapdown.h"

#include "fusion/geometry/earth.h"
#include "fusion/geometry/rotation.h"

namespace locus::inertial {
namespace {

constexpr double earth_gm_m3ps2 = 3.986004418e14; // WGS-84

Eigen::Vector3d earth_turn_radps() { return {0, 0, earth_rate_radps}; }

constexpr int axis_order(int axis, int order) { return 3 * axis + order; }

void add(ErrorTransition& f, int row_order, int column_order, const Eigen::Matrix3d& block) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) f(axis_order(i, row_order), axis_order(j, column_order)) += block(i, j);
}

} // namespace

// Groves eq. 5.27-5.31, 5.35-5.38.
void move(EcefMotion& motion, const Rates& unbiased, double dt_s) noexcept {
    // The body turns during the step: the force acts, on average, from half way.
    const Eigen::Quaterniond half_way = rotation(-0.5 * dt_s * earth_turn_radps()) * motion.body_to_ecef *
                                        rotation(0.5 * dt_s * unbiased.angular_rate_radps);
    const Eigen::Vector3d acceleration = half_way * unbiased.specific_force_mps2 +
                                         gravity_ecef_mps2(motion.position_ecef_m) -
                                         2 * earth_turn_radps().cross(motion.velocity_ecef_mps);
    motion.position_ecef_m += dt_s * (motion.velocity_ecef_mps + 0.5 * dt_s * acceleration);
    motion.velocity_ecef_mps += dt_s * acceleration;
    motion.body_to_ecef =
        (rotation(-dt_s * earth_turn_radps()) * motion.body_to_ecef * rotation(dt_s * unbiased.angular_rate_radps))
            .normalized();
}

// With w(t) = w + d t/T and f(t) = f + e t/T the turn is (w + d/2) T + w x d T^2/12 and the change of velocity, seen
// from the body at the start, (f + e/2) T + [w x f/2 + w x e/3 + d x f/6 + d x e/8] T^2; what holding gave is taken
// off.
void catch_up(EcefMotion& motion, const Rates& held, const HeldImu::Lag& lag) noexcept {
    const double t = lag.held_s;
    const Eigen::Vector3d &w = held.angular_rate_radps, &f = held.specific_force_mps2;
    const Eigen::Vector3d &d = lag.difference.angular_rate_radps, &e = lag.difference.specific_force_mps2;
    const Eigen::Quaterniond at_start = motion.body_to_ecef * rotation(-t * w);
    const Eigen::Vector3d change = t / 2 * e + t * t * (w.cross(e) / 3 + d.cross(f) / 6 + d.cross(e) / 8);
    motion.position_ecef_m += at_start * (t * t / 6 * e);
    motion.velocity_ecef_mps += at_start * change;
    motion.body_to_ecef = (motion.body_to_ecef * rotation(t / 2 * d - t * t / 6 * w.cross(d))).normalized();
}

// Groves eq. 14.48 and 14.49.
ErrorTransition error_transition(const EcefMotion& motion, const Rates& unbiased, double dt_s) noexcept {
    ErrorTransition f = error_transition(Motion{{}, {}, motion.body_to_ecef}, unbiased, dt_s);
    const Eigen::Matrix3d turn = skew(earth_turn_radps());
    const Eigen::Matrix3d gradient = gravity_gradient(motion.position_ecef_m);
    add(f, 2, 2, -dt_s * turn);
    add(f, 1, 1, -2 * dt_s * turn);
    add(f, 1, 0, dt_s * gradient);
    add(f, 0, 1, -dt_s * dt_s * turn);
    add(f, 0, 0, 0.5 * dt_s * dt_s * gradient);
    return f;
}

Eigen::Matrix3d gravity_gradient(const Eigen::Vector3d& position_ecef_m) noexcept {
    const double r = position_ecef_m.norm();
    const Eigen::Vector3d up = position_ecef_m / r;
    const Eigen::Matrix3d turn = skew(earth_turn_radps());
    return earth_gm_m3ps2 / (r * r * r) * (3 * up * up.transpose() - Eigen::Matrix3d::Identity()) - turn * turn;
}

} // namespace locus::inertial
