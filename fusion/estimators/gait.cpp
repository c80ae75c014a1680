#include "fusion/estimators/gait.h"

#include <algorithm>
#include <cmath>

namespace locus {
namespace {

/// Without a sample for this long the unit is gone.
constexpr double silence_s = 0.5;
/// Without a step for this many steps' time the walker has stopped.
constexpr double late_step = 1.4;
constexpr int enough_steps = 2;
/// A person's step factor hardly changes: a hundredth in ten seconds.
constexpr double factor_wander_rts = 0.003;

double squared(double x) { return x * x; }

} // namespace

Eigen::Vector2d Gait::facing(double heading_rad) noexcept { return {std::cos(heading_rad), std::sin(heading_rad)}; }

bool Gait::heard(Timestamp time) const noexcept { return any_sample_ && to_s(time - time_) <= silence_s; }

void Gait::hear(const ImuSample& sample, Timestamp time) noexcept {
    const double dt_s = any_sample_ ? to_s(time - time_) : 0;
    if (any_sample_ && dt_s <= 0) return;
    if (!heard(time)) {
        leads_ = false;
        stop();
    }
    time_ = time;
    any_sample_ = true;
    const auto step = pedestrian_.hear(sample, time);
    go_on(std::min(dt_s, silence_s));
    if (step) make_good(*step);
    const bool late = to_s(time - told_) > late_step * step_s_;
    if (speed_mps_ > 0 && (late || pedestrian_.standing())) stop();
}

void Gait::go_on(double dt_s) noexcept {
    const double way_m = speed_mps_ * dt_s;
    gone_m_ += way_m;
    gathered_m_ += way_m * facing(pedestrian_.heading_rad());
    place_variance_m2_ += squared(settings_.shuffle_m_rts) * dt_s;
    turn_variance_rad2_ += squared(settings_.course_wander_rad_rts) * dt_s;
}

void Gait::make_good(const inertial::Step& step) noexcept {
    gathered_m_ += (step.length_m - gone_m_) * facing(step.heading_rad);
    place_variance_m2_ += squared(step.length_sigma_m);
    gone_m_ = 0;
    speed_mps_ = step.length_m / step.duration_s;
    step_s_ = step.duration_s;
    told_ = time_;
    leads_ = leads_ || ++steps_in_a_row_ >= enough_steps;
}

/// What was gone on beyond the last step was no way.
void Gait::stop() noexcept {
    gathered_m_ -= gone_m_ * facing(pedestrian_.heading_rad());
    gone_m_ = 0;
    speed_mps_ = 0;
    steps_in_a_row_ = 0;
}

filter::ParticleMove Gait::take() noexcept {
    filter::ParticleMove move;
    move.move = gathered_m_;
    move.place_sigma_m = std::sqrt(place_variance_m2_);
    const double unit_variance = pedestrian_.heading_variance_rad2();
    const double grown = std::max(0.0, unit_variance - heading_variance_rad2_);
    move.drive_turn_sigma_rad = std::sqrt(grown + turn_variance_rad2_);
    move.drive_length_sigma = factor_wander_rts / settings_.course_wander_rad_rts * std::sqrt(turn_variance_rad2_);
    gathered_m_.setZero();
    place_variance_m2_ = turn_variance_rad2_ = 0;
    heading_variance_rad2_ = unit_variance;
    return move;
}

Eigen::Vector2d Gait::outlook(Timestamp time) const noexcept {
    const double ahead_s = std::clamp(to_s(time - time_), 0.0, silence_s);
    return gathered_m_ + ahead_s * speed_mps();
}

} // namespace locus
