#include "fusion/estimators/kalman.h"

namespace locus {

filter::FixFilterModel fix_filter_model(const KalmanSettings& settings) noexcept {
    filter::FixFilterModel model;
    model.velocity_walk = settings.velocity_walk;
    model.start_speed_sigma_mps = settings.speed_sigma_mps;
    model.planar = settings.planar;
    return model;
}

filter::FixFilterModel fix_filter_model(const ColouredKalmanSettings& settings) noexcept {
    const double held = settings.anchor_error_sigma_m * settings.anchor_error_sigma_m;
    const double fresh = settings.range_sigma_m * settings.range_sigma_m;
    filter::FixFilterModel model = fix_filter_model(static_cast<const KalmanSettings&>(settings));
    model.carried_share = held / (held + fresh);
    model.carried_time_s = settings.anchor_error_time_s;
    return model;
}

void PcaKalman::take(const Eigen::Vector3d& position_m, const Eigen::Matrix3d& covariance_m2, Timestamp time) noexcept {
    const filter::PcaWindow::Denoised denoised = window_.take(position_m, covariance_m2);
    filter_.take(denoised.position_m, denoised.degradation * covariance_m2, time);
}

} // namespace locus
