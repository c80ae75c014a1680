#include "fusion/estimators/kalman.h"

namespace locus {

filter::FixFilterModel fix_filter_model(const KalmanSettings& settings) noexcept {
    filter::FixFilterModel model;
    model.velocity_walk = settings.velocity_walk;
    model.start_speed_sigma_mps = settings.speed_sigma_mps;
    model.planar = settings.planar;
    return model;
}

namespace {

/// Each fix's variance in the shares that an anchor's noise and held error have of a range's.
filter::FixFilterModel with_held_errors(const KalmanSettings& settings, double time_s) noexcept {
    const double held = settings.anchor_error_sigma_m * settings.anchor_error_sigma_m;
    const double fresh = settings.range_sigma_m * settings.range_sigma_m;
    filter::FixFilterModel model = fix_filter_model(settings);
    model.carried_share = held / (held + fresh);
    model.carried_time_s = time_s;
    return model;
}

} // namespace

filter::FixFilterModel fix_filter_model(const ColouredKalmanSettings& settings) noexcept {
    return with_held_errors(settings, settings.anchor_error_time_s);
}

CarriedPca::CarriedPca(const CarriedPcaSettings& settings) noexcept
    : PcaKalman(settings, with_held_errors(settings, settings.anchor_error_time_s)) {}

void PcaKalman::take(const Eigen::Vector3d& position_m, const Eigen::Matrix3d& covariance_m2, Timestamp time) noexcept {
    const filter::PcaWindow::Denoised denoised = window_.take(position_m, covariance_m2);
    filter_.take(denoised.position_m, denoised.degradation * covariance_m2, time);
}

} // namespace locus
