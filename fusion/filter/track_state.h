// What a range filter knows of one target: nine numbers of motion (paper 001 eq. 1), and the errors that its sources
// carry along (wandering_state.h).
#pragma once

#include "fusion/filter/kinematic_state.h"
#include "fusion/filter/scalar_update.h"

namespace locus::filter {

class TrackState : public KinematicState<9> {
  public:
    using KinematicState::KinematicState;

    /// At rest at `position_m` with covariance in m^2; all wanderers are forgotten.
    void start(const Eigen::Vector3d& position_m, const Eigen::Matrix3d& covariance_m2) noexcept {
        start_motion(position_m, covariance_m2);
    }

    /// `dt_s` >= 0.
    void predict(double dt_s) noexcept {
        if (dt_s > 0) predict_motion(dt_s);
    }

    Eigen::Vector3d antenna_site_m() const noexcept { return position_m(); }
    /// From the gradient of an observation by the antenna's position to its gradient by the state, which was zero.
    void spread_gradient(const Eigen::Vector3d& gradient, Vector& jacobian) const noexcept;
    void correct(const Prediction<Vector>& prediction, double innovation, double variance, const Share& share) noexcept;
    void report(Estimate& estimate) const noexcept { report_motion(estimate); }
};

} // namespace locus::filter
