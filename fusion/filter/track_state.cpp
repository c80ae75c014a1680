#include "fusion/filter/track_state.h"

#include "fusion/filter/kinematics.h"

namespace locus::filter {

void TrackState::start(const Eigen::Vector3d& position_m, const Eigen::Matrix3d& covariance_m2) noexcept {
    clear(motion_size);
    start_axes(state, covariance, model_, position_m, covariance_m2);
}

void TrackState::predict(double dt_s) noexcept {
    if (dt_s == 0) return;
    const AxisStep step = axis_step(model_.motion, dt_s);
    move_axes(state, covariance, model_, step);
    wander([&](auto column, double keep) { move_column(column, step, keep); }, dt_s);
}

void TrackState::spread_gradient(const Eigen::Vector3d& gradient, Vector& jacobian) const noexcept {
    for (int axis = 0; axis < 3; ++axis) jacobian(place(axis, 0)) = gradient(axis);
}

void TrackState::correct(const Prediction<Vector>& prediction, double innovation, double variance,
                         const Share& share) noexcept {
    update_scalar(state, covariance, prediction, innovation, variance, share);
}

void TrackState::report(Estimate& estimate) const noexcept {
    for (int i = 0; i < 3; ++i) {
        estimate.position_site_m[i] = state(place(i, 0));
        estimate.velocity_site_mps[i] = state(place(i, 1));
    }
    const auto seen = [](int i) { return place(i % 3, i / 3); };
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) estimate.covariance[6 * i + j] = covariance(seen(i), seen(j));
}

} // namespace locus::filter
