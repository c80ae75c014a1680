// What a range filter knows of one target: nine numbers of motion (paper 001 eq. 1), and the errors that its sources
// carry along (wandering_state.h).
#pragma once

#include "fusion/filter/kinematics.h"
#include "fusion/filter/scalar_update.h"
#include "fusion/filter/wandering_state.h"
#include "fusion/pose.h"

namespace locus::filter {

class TrackState : public WanderingState<9> {
  public:
    static constexpr int motion_size = 9;

    explicit TrackState(const TrackModel& model) noexcept : WanderingState(motion_size), model_(model) {}

    /// At rest at `position_m` with covariance in m^2; all wanderers are forgotten.
    void start(const Eigen::Vector3d& position_m, const Eigen::Matrix3d& covariance_m2) noexcept;

    /// Paper 001 eq. 4 and 8; `dt_s` >= 0.
    void predict(double dt_s) noexcept;

    Eigen::Vector3d antenna_site_m() const noexcept { return position_m(); }
    /// From the gradient of an observation by the antenna's position to its gradient by the state, which was zero.
    void spread_gradient(const Eigen::Vector3d& gradient, Vector& jacobian) const noexcept;
    void correct(const Prediction<Vector>& prediction, double innovation, double variance, const Share& share) noexcept;
    void report(Estimate& estimate) const noexcept;

  private:
    TrackModel model_;
};

} // namespace locus::filter
