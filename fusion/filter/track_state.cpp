#include "fusion/filter/track_state.h"

namespace locus::filter {

void TrackState::spread_gradient(const Eigen::Vector3d& gradient, Vector& jacobian) const noexcept {
    for (int axis = 0; axis < 3; ++axis) jacobian(place(axis, 0)) = gradient(axis);
}

void TrackState::correct(const Prediction<Vector>& prediction, double innovation, double variance,
                         const Share& share) noexcept {
    update_scalar(state, covariance, prediction, innovation, variance, share);
}

} // namespace locus::filter
