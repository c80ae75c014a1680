// A state whose core begins with nine numbers of motion (kinematics.h) and which reports them: what tracks of ranges
// and tracks with an inertial sensor have in common.
#pragma once

#include "fusion/filter/kinematics.h"
#include "fusion/filter/wandering_state.h"
#include "fusion/pose.h"

namespace locus::filter {

template <int MaxCore>
class KinematicState : public WanderingState<MaxCore> {
  public:
    using Base = WanderingState<MaxCore>;
    using Base::place;
    static constexpr int motion_size = 9;

    explicit KinematicState(const TrackModel& model) noexcept : WanderingState<MaxCore>(motion_size), model_(model) {}

    Eigen::Vector3d velocity_mps() const noexcept { return {this->state(1), this->state(4), this->state(7)}; }

    /// How it moves without an inertial sensor.
    const MotionModel& motion_model() const noexcept { return model_.motion; }
    void move_as(const MotionModel& motion) noexcept { model_.motion = motion; }

  protected:
    /// At rest at `position_m` with covariance in m^2; all wanderers are forgotten.
    void start_motion(const Eigen::Vector3d& position_m, const Eigen::Matrix3d& covariance_m2) noexcept {
        this->clear(motion_size);
        start_axes(this->state, this->covariance, model_, position_m, covariance_m2);
    }

    /// Paper 001 eq. 4 and 8; the core is no more than the motion.
    void predict_motion(double dt_s) noexcept {
        const AxisStep step = axis_step(model_.motion, dt_s);
        move_axes(this->state, this->covariance, model_, step);
        this->wander([&](auto column, double keep) { move_column(column, step, keep); }, dt_s);
    }

    /// A map of cores that keeps position and velocity; what the third numbers mean is another matter.
    static typename Base::CoreMap way(int to, int from) noexcept {
        typename Base::CoreMap map = Base::CoreMap::Zero(to, from);
        for (int axis = 0; axis < 3; ++axis)
            for (int order = 0; order < 2; ++order) map(place(axis, order), place(axis, order)) = 1;
        return map;
    }

    void report_motion(Estimate& estimate) const noexcept {
        for (int axis = 0; axis < 3; ++axis) {
            estimate.position_site_m[axis] = this->state(place(axis, 0));
            estimate.velocity_site_mps[axis] = this->state(place(axis, 1));
        }
        const auto seen = [](int i) { return place(i % 3, i / 3); };
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j) estimate.covariance[6 * i + j] = this->covariance(seen(i), seen(j));
    }

  private:
    TrackModel model_;
};

} // namespace locus::filter
