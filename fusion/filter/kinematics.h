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

// NOLINTBEGIN(cppcoreguidelines-missing-std-forward): columns are temporaries that stand for what they refer to
/// F x for the transition F of axis_step(): the numbers below its diagonal are zero and the upper two on it are one.
/// Written out, it takes half the time of full matrices.
template <class Numbers>
void advance(const Eigen::Matrix3d& transition, Numbers&& position, Numbers&& velocity,
             Numbers&& acceleration) noexcept {
    position += transition(0, 1) * velocity + transition(0, 2) * acceleration;
    velocity += transition(1, 2) * acceleration;
    acceleration *= transition(2, 2);
}

/// F P F' in the upper half: first P F', three columns at a time, then F from the left, three numbers of a column.
template <class Vector, class Matrix>
void move_axes(Vector& state, Matrix& covariance, const TrackModel& model, const AxisStep& step) noexcept {
    const auto column = [&](int k) { return covariance.col(k).template head<9>(); };
    for (int i = 0; i < 9; i += 3) {
        advance(step.transition, state(i), state(i + 1), state(i + 2));
        advance(step.transition, column(i), column(i + 1), column(i + 2));
    }
    for (int k = 0; k < 9; ++k)
        for (int i = 0; i <= k; i += 3)
            advance(step.transition, covariance(i, k), covariance(i + 1, k), covariance(i + 2, k));
    const int axes = model.planar ? 2 : 3;
    for (int i = 0; i < axes; ++i) covariance.template block<3, 3>(3 * i, 3 * i) += step.noise;
}

/// Covariance of the nine numbers with another one that keeps `keep` of itself.
template <class Column>
void move_column(Column&& column, const AxisStep& step, double keep) noexcept {
    column *= keep;
    for (int i = 0; i < 9; i += 3) advance(step.transition, column(i), column(i + 1), column(i + 2));
}
// NOLINTEND(cppcoreguidelines-missing-std-forward)

} // namespace locus::filter
