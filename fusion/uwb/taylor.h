// Taylor refinement (paper 000 eq. 8-11): Gauss-Newton steps, damped in Levenberg's manner when a step does not lower
// the cost, so that it ends in a minimum or stays where it was but never runs away.
#pragma once

#include "fusion/uwb/epoch.h"
#include "fusion/uwb/normal_equations.h"

namespace locus::uwb {

/// D unknowns: 3, or 2 for x and y in the plane z = 0 of the epoch's frame.
template <int D>
struct Minimum {
    Eigen::Vector3d position_m = Eigen::Vector3d::Zero(); ///< epoch's frame
    Eigen::Matrix<double, D, D> information = Eigen::Matrix<double, D, D>::Zero();
    double cost = 0;
    bool converged = false;

    /// Whether a position is this minimum, but for one standard deviation and no more than a metre: one that is almost
    /// flat must not swallow the others.
    bool is_at(const Eigen::Vector3d& other_m) const {
        const Eigen::Matrix<double, D, 1> apart = (other_m - position_m).template head<D>();
        return apart.dot(information * apart) < 1 && apart.squaredNorm() < 1;
    }
};

/// Descends from `start_m`. Where a minimum is `known` already, ends as soon as it is clear that it leads there.
template <int D>
Minimum<D> refine(const Epoch& epoch, const Eigen::Vector3d& start_m, const Minimum<D>* known = nullptr);

} // namespace locus::uwb
