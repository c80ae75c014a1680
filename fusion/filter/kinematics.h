// Nine numbers of motion at the head of a state: how they start and how time moves them. The transition is one 3 x 3
// block three times, so all products are taken block by block. For every filter whose core begins with them.
#pragma once

#include "fusion/filter/motion.h"

#include <Eigen/Core>

namespace locus::filter {

struct TrackModel {
    MotionModel motion;
    double start_speed_sigma_mps = 1;
    bool planar = false; ///< the height is known: nothing moves it
};

/// At rest at `position_m`; everything was zero before.
template <class Vector, class Matrix>
void start_axes(Vector& state, Matrix& covariance, const TrackModel& model, const Eigen::Vector3d& position_m,
                const Eigen::Matrix3d& covariance_m2) noexcept {
    const auto place = [](int axis, int order) { return 3 * axis + order; };
    const int axes = model.planar ? 2 : 3;
    for (int i = 0; i < 3; ++i) state(place(i, 0)) = position_m(i);
    for (int i = 0; i < axes; ++i) {
        for (int j = 0; j < axes; ++j) covariance(place(i, 0), place(j, 0)) = covariance_m2(i, j);
        covariance(place(i, 1), place(i, 1)) = model.start_speed_sigma_mps * model.start_speed_sigma_mps;
        covariance(place(i, 2), place(i, 2)) =
            model.motion.acceleration_sigma_mps2 * model.motion.acceleration_sigma_mps2;
    }
}

/// Of the covariance only the upper triangle of blocks is moved.
template <class Vector, class Matrix>
void move_axes(Vector& state, Matrix& covariance, const TrackModel& model, const AxisStep& step) noexcept {
    const int axes = model.planar ? 2 : 3;
    for (int i = 0; i < 3; ++i)
        state.template segment<3>(3 * i) = (step.transition * state.template segment<3>(3 * i)).eval();
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i <= j; ++i)
            covariance.template block<3, 3>(3 * i, 3 * j) =
                (step.transition * covariance.template block<3, 3>(3 * i, 3 * j) * step.transition.transpose()).eval();
    for (int i = 0; i < axes; ++i) covariance.template block<3, 3>(3 * i, 3 * i) += step.noise;
}

/// Covariance of the nine numbers with another one that keeps `keep` of itself.
template <class Column>
void move_column(Column&& column, const AxisStep& step, double keep) noexcept {
    for (int i = 0; i < 3; ++i)
        column.template segment<3>(3 * i) = (step.transition * column.template segment<3>(3 * i) * keep).eval();
}

} // namespace locus::filter
