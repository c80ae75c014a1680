#include "fusion/inertial/pedestrian.h"

#include "fusion/geometry/vector.h"

#include <cmath>

namespace locus::inertial {
namespace {

/// Error of the mean force over levelling_s in the middle of a walk; at rest it is far less, and soon found to be.
constexpr double levelling_sigma_mps2 = 1;

} // namespace

std::optional<Step> Pedestrian::hear(const ImuSample& sample, Timestamp time) noexcept {
    const double dt_s = last_time_ ? to_s(time - *last_time_) : 0;
    if (last_time_ && dt_s <= 0) return std::nullopt;
    last_time_ = time;
    const Eigen::Vector3d force = vector(sample.specific_force_mps2);
    const std::optional<Stride> stride = steps_.hear(time, force.norm());
    if (!ready_) {
        level_first(force, dt_s);
        return std::nullopt;
    }
    follow(sample, dt_s);
    if (!stride || standing_) return std::nullopt;
    return make(*stride);
}

void Pedestrian::level_first(const Eigen::Vector3d& force, double dt_s) noexcept {
    force_sum_ += force * dt_s;
    levelled_s_ += dt_s;
    if (levelled_s_ < settings_.levelling_s || force_sum_.isZero()) return;
    attitude_.start(force_sum_, levelling_sigma_mps2);
    ready_ = true;
}

void Pedestrian::follow(const ImuSample& sample, double dt_s) noexcept {
    const Eigen::Vector3d force = vector(sample.specific_force_mps2), rate = vector(sample.angular_rate_radps);
    attitude_.turn(rate, dt_s);
    attitude_.level(force, dt_s);
    standing_ = standing_still_.hear(force, rate - attitude_.gyro_bias_radps(), dt_s);
    if (standing_) attitude_.rest(rate, dt_s);
    if (settings_.use_compass && std::isfinite(sample.magnetic_field_ut[0])) {
        const Eigen::Vector3d field = Eigen::Map<const Eigen::Vector3f>(sample.magnetic_field_ut.data()).cast<double>();
        if (const auto error_rad = compass_.hear(attitude_.body_to_level() * field, dt_s))
            attitude_.correct_heading(*error_rad, compass_.sigma_rad());
    }
    facing_sum_ += dt_s * Eigen::Vector2d(std::cos(heading_rad()), std::sin(heading_rad()));
}

Step Pedestrian::make(const Stride& stride) noexcept {
    Step step;
    step.time = stride.time;
    step.duration_s = stride.duration_s;
    step.length_m = step_length_m(settings_.length, stride.amplitude_mps2);
    step.length_sigma_m = settings_.length.step_sigma * step.length_m;
    step.heading_rad = std::atan2(facing_sum_.y(), facing_sum_.x());
    step.heading_sigma_rad = std::sqrt(heading_variance_rad2());
    facing_sum_.setZero();
    return step;
}

} // namespace locus::inertial
