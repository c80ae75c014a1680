#include "fusion/estimators/walking_cloud.h"

#include "fusion/geometry/turn_and_stretch.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace locus {

void WalkingCloud::copy_from(const WalkingCloud& other) noexcept {
    cloud_.copy_from(other.cloud_);
    gait_ = other.gait_;
    by_steps_ = other.by_steps_;
    time_ = other.time_;
}

void WalkingCloud::begin(Timestamp time) noexcept {
    cloud_.settle();
    gait_.take();
    time_ = time;
}

void WalkingCloud::advance(Timestamp time) noexcept {
    if (time == time_) return;
    const bool steps = gait_.leads() && gait_.heard(time);
    if (steps && !by_steps_) lead_by_steps();
    if (!steps && by_steps_) lead_by_velocity();
    const double dt_s = to_s(time - time_);
    if (!by_steps_) forget_velocity(dt_s);
    const filter::ParticleMove move = by_steps_ ? gait_.take() : wander(dt_s);
    cloud_.move(move);
    stop_at_walls(move.move.norm() * cloud_.mean().tail<2>().norm() + 4 * move.place_sigma_m);
    cloud_.settle();
    time_ = time;
}

void WalkingCloud::stop_at_walls(double move_m) noexcept {
    if (site_->walls.empty()) return;
    const Eigen::Vector2d reach_m =
        5 * cloud_.covariance().diagonal().head<2>().cwiseSqrt() + Eigen::Vector2d::Constant(move_m + 1);
    const Eigen::AlignedBox2d near(cloud_.mean().head<2>() - reach_m, cloud_.mean().head<2>() + reach_m);
    cloud_.begin_walls();
    for (const Wall& wall : site_->walls) {
        const Eigen::Vector2d from_m = local(wall.from_site_m), to_m = local(wall.to_site_m);
        const Eigen::AlignedBox2d box(from_m.cwiseMin(to_m), from_m.cwiseMax(to_m));
        if (near.intersects(box)) cloud_.hit_wall(from_m, to_m);
    }
    cloud_.end_walls();
}

/// The direction of the velocity, where there is a clear one, tells how the unit's heading lies in the site; else every
/// direction is as likely.
void WalkingCloud::lead_by_steps() noexcept {
    gait_.take();
    const Eigen::Vector2d velocity = cloud_.mean().tail<2>(), gait = gait_.speed_mps();
    const double sigma = std::sqrt(0.5 * cloud_.covariance().bottomRightCorner<2, 2>().trace());
    const double speed = velocity.norm();
    if (speed > 3 * sigma && gait.norm() > 0)
        cloud_.redraw_drives(quotient(velocity / speed, gait / gait.norm()),
                             std::hypot(sigma / speed, settings_.person_sigma));
    else
        cloud_.redraw_drives({0, 0}, 1);
    cloud_.weigh_drive_length(2 * settings_.person_sigma);
    settle();
    by_steps_ = true;
}

void WalkingCloud::lead_by_velocity() noexcept {
    cloud_.turn_drives(gait_.speed_mps());
    cloud_.settle();
    by_steps_ = false;
}

bool WalkingCloud::settle() noexcept {
    const bool alive = cloud_.settle();
    cloud_.resample_if_poor();
    return alive;
}

} // namespace locus
