// What a cloud of walkers says of a time that no measurement has reached yet.
#include "fusion/estimators/walking_cloud.h"

#include "fusion/geometry/turn_and_stretch.h"

#include <algorithm>
#include <cmath>

namespace locus {
namespace {

/// Within a step the body is now faster, now slower.
constexpr double within_step_mps = 0.2;
/// A hip rises and falls by some centimetres, twice a second.
constexpr double rise_variance = 0.01;

/// Into the six of (position, velocity), of which a floor moves four.
void write_floor(const Eigen::Matrix4d& covariance, Estimate& estimate) {
    constexpr std::array<std::size_t, 4> at{0, 1, 3, 4};
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t column = 0; column < 4; ++column)
            estimate.covariance[6 * at[row] + at[column]] =
                covariance(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
}

} // namespace

/// Velocity over drive.
Eigen::Vector2d WalkingCloud::pace() const noexcept { return by_steps_ ? gait_.speed_mps() : Eigen::Vector2d(1, 0); }

/// White acceleration, seen as a velocity that changes by half at the beginning and half at the end.
filter::ParticleMove WalkingCloud::wander(double dt_s) const noexcept {
    filter::ParticleMove move;
    move.move = {dt_s, 0};
    move.drive_sigma = settings_.velocity_wander_mps_rts * std::sqrt(dt_s);
    move.place_sigma_m = move.drive_sigma * dt_s / std::sqrt(12.0);
    return move;
}

/// As an Ornstein-Uhlenbeck process: what is left of a velocity after a while.
void WalkingCloud::forget_velocity(double dt_s) noexcept {
    if (std::isfinite(settings_.velocity_time_s)) cloud_.turn_drives({std::exp(-dt_s / settings_.velocity_time_s), 0});
}

Eigen::Vector3d WalkingCloud::place_site_m() const noexcept {
    const Eigen::Vector2d place = cloud_.mean().head<2>() + origin_;
    return {place.x(), place.y(), settings_.height_m};
}

void WalkingCloud::write(Timestamp time, Estimate& estimate) const noexcept {
    const double dt_s = std::max(0.0, to_s(time - time_));
    const filter::ParticleMove wandering = wander(dt_s);
    const Eigen::Vector2d ahead = by_steps_ ? gait_.outlook(time) : wandering.move;
    const double speed_sigma = by_steps_ ? within_step_mps : wandering.drive_sigma;
    const double wandered_m2 = wandering.drive_sigma * wandering.drive_sigma * dt_s * dt_s / 3;

    Eigen::Matrix4d by_state = Eigen::Matrix4d::Identity();
    by_state.topRightCorner<2, 2>() = product_matrix(ahead);
    by_state.bottomRightCorner<2, 2>() = product_matrix(pace());
    Eigen::Matrix4d covariance = by_state * cloud_.covariance() * by_state.transpose();
    covariance.diagonal().head<2>().array() += by_steps_ ? gait_.place_variance_m2() : wandered_m2;
    covariance.diagonal().tail<2>().array() += speed_sigma * speed_sigma;
    write_floor(covariance, estimate);
    estimate.covariance[14] = settings_.height_sigma_m * settings_.height_sigma_m;
    estimate.covariance[35] = rise_variance;
    const Eigen::Vector4d state = by_state * cloud_.mean();
    estimate.position_site_m = {state(0) + origin_.x(), state(1) + origin_.y(), settings_.height_m};
    estimate.velocity_site_mps = {state(2), state(3), 0};
}

} // namespace locus
