#include "fusion/estimators/nav_filter.h"

#include "fusion/estimators/carried_keys.h"

#include <algorithm>
#include <cmath>

namespace locus {
namespace {

NavModel nav_model(const InertialEkfSettings& s) {
    NavModel model;
    model.kinematic = {{s.acceleration_sigma_mps2, s.acceleration_time_s}, s.speed_sigma_mps, s.planar};
    model.imu = {s.acceleration_noise_mps2_rthz, s.angular_rate_noise_radps_rthz, s.acceleration_bias_walk_mps2_rts,
                 s.angular_rate_bias_walk_radps_rts};
    model.acceleration_bias_sigma_mps2 = s.acceleration_bias_sigma_mps2;
    model.angular_rate_bias_sigma_radps = s.angular_rate_bias_sigma_radps;
    model.aligning_noise_mps2_rthz = s.aligning_noise_mps2_rthz;
    model.foot_mounted = s.foot_mounted;
    model.antenna_body_m = vector(s.antenna_body_m);
    return model;
}

/// How still what stands is, and how soon its next look is news: somebody who stands sways slowly; a foot in mid-stance
/// rolls by a centimetre (Skog et al. 2010, stance.h) and is gone after a third of a second.
struct Standstill {
    double sigma_mps;
    Duration period;
};
constexpr Standstill whole_body{0.05, std::chrono::milliseconds{100}},
    standing_foot{0.03, std::chrono::milliseconds{20}};
constexpr double least_speed_mps = 0.01;

double variance(float stated_sigma, double otherwise) {
    const double sigma = std::isfinite(stated_sigma) && stated_sigma > 0 ? double{stated_sigma} : otherwise;
    return sigma * sigma;
}

} // namespace

NavFilter::NavFilter(const Site& site, const InertialEkfSettings& settings)
    : RangeFilter(site, settings, NavTrack(nav_model(settings))), settings_(settings),
      height_robust_(settings.robust_scale), speed_robust_(settings.robust_scale),
      standstill_robust_(settings.robust_scale), foot_robust_(settings.robust_scale),
      place_robust_(settings.robust_scale) {}

Verdict NavFilter::update(const Measurement& measurement) noexcept {
    if (const auto* imu = std::get_if<ImuSample>(&measurement.observation)) return take(*imu, measurement.time);
    if (const auto* foot = std::get_if<FootPoint>(&measurement.observation)) return take(*foot, measurement.time);
    const auto* height = std::get_if<Height>(&measurement.observation);
    const auto* wheel = std::get_if<WheelSpeed>(&measurement.observation);
    if (height == nullptr && wheel == nullptr) return RangeFilter::update(measurement);
    if (!has_position()) return {Exclusion::waiting_for_start};
    move_to(measurement.time);
    const Verdict verdict = height != nullptr ? take(*height) : take(*wheel);
    if (verdict.reason == Exclusion::none) note_use(measurement.observation, measurement.time);
    return verdict;
}

Verdict NavFilter::take(const ImuSample& sample, Timestamp time) noexcept {
    if (has_position()) move_to(time);
    track_.sense(sample, time, has_position());
    const bool may = track_.is_inertial() || (settings_.foot_mounted && has_position());
    const bool stands = settings_.zero_velocity && may && track_.is_at_rest();
    const Standstill& still = settings_.foot_mounted ? standing_foot : whole_body;
    if (!stands || time - stood_ < still.period) return {};
    stood_ = time;
    stand(still.sigma_mps);
    return {};
}

void NavFilter::stand(double sigma_mps) noexcept {
    for (int axis = 0; axis < 3; ++axis) {
        Scalar scalar;
        scalar.jacobian.setZero(track_.size());
        scalar.jacobian(NavTrack::place(axis, 1)) = 1;
        scalar.innovation = -track_.velocity_mps()(axis);
        scalar.variance = sigma_mps * sigma_mps;
        weigh(scalar, standstill_gates_[static_cast<std::size_t>(axis)], standstill_robust_);
    }
}

Verdict NavFilter::take(const Height& height) noexcept {
    Scalar scalar;
    const filter::WanderModel error{settings_.height_error_sigma_m, settings_.height_error_time_s};
    const int error_at = track_.wanderer(carried::height, error);
    scalar.jacobian.setZero(track_.size());
    track_.spread_gradient(Eigen::Vector3d::UnitZ(), scalar.jacobian);
    scalar.jacobian(error_at) = 1;
    const double antenna_m = height.height_site_m - settings_.height_offset_m - track_.state(error_at);
    scalar.innovation = antenna_m - track_.antenna_site_m().z();
    scalar.variance = variance(height.sigma_m, settings_.height_sigma_m);
    return weigh(scalar, height_gate_, height_robust_);
}

/// Backwards counts as fast as forwards: which way the wheels point is not known here.
Verdict NavFilter::take(const WheelSpeed& wheel) noexcept {
    const Eigen::Vector2d velocity_mps = track_.velocity_mps().head<2>();
    const double speed_mps = velocity_mps.norm();
    Scalar scalar;
    scalar.jacobian.setZero(track_.size());
    for (int axis = 0; axis < 2; ++axis) // at rest the speed has no gradient: such a sample moves nothing
        scalar.jacobian(NavTrack::place(axis, 1)) = velocity_mps(axis) / std::max(speed_mps, least_speed_mps);
    scalar.innovation = std::abs(wheel.speed_mps) - speed_mps;
    scalar.variance = variance(wheel.sigma_mps, settings_.speed_sigma_of_wheel_mps);
    return weigh(scalar, speed_gate_, speed_robust_);
}

void NavFilter::restart_from(const NavFilter& other) noexcept {
    const NavTrack before = track_;
    const double patience_s = forget_after_s();
    *this = other;
    forget_after(patience_s);
    track_.keep_sensor(before);
}

void NavFilter::go_with(const NavFilter& other) noexcept {
    const filter::MotionModel own = track_.motion_model();
    *this = other;
    track_.move_as(own);
}

bool NavFilter::interact(NavFilter& second, const filter::ModelPair::Mixing& mixing) noexcept {
    if (!track_.is_laid_out_as(second.track_)) return false;
    filter::interact(track_.state, track_.covariance, second.track_.state, second.track_.covariance, mixing);
    return true;
}

} // namespace locus
