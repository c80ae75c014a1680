#include "fusion/uwb/taylor.h"

#include "fusion/uwb/range_model.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace locus::uwb {
namespace {

constexpr int max_steps = 40;
constexpr double small_step_m = 1e-4; ///< Gauss-Newton's next step would be smaller by the ratio of noise to distance
constexpr double first_damping = 1e-3;

/// Gradient and distance of every anchor, 4 x anchors; zero for no_anchor.
using Sights = Eigen::Matrix<double, 4, Eigen::Dynamic, Eigen::ColMajor, 4, Epoch::max_anchors>;

Sights look(const Epoch& epoch, const Eigen::Vector3d& position_m) {
    Sights sights(4, epoch.anchors_m.cols());
    sights.col(Epoch::no_anchor).setZero();
    for (int i = 1; i < epoch.anchors_m.cols(); ++i) {
        sights.col(i).head<3>() = range_gradient(position_m, epoch.anchors_m.col(i));
        sights(3, i) = range(position_m, epoch.anchors_m.col(i));
    }
    return sights;
}

/// No step is longer than the anchors stand apart: beyond, the linearisation says nothing.
double longest_step_m(const Epoch& epoch) { return epoch.real_anchors_m().colwise().norm().maxCoeff(); }

template <int D>
Eigen::Vector3d damped_step(const NormalEquations<D>& here, double damping, double longest_m) {
    Eigen::Matrix<double, D, D> damped = here.information;
    damped.diagonal().array() += damping * here.information.trace();
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    step.head<D>() = damped.inverse() * here.projection; // eq. 11
    const double length_m = step.norm();
    return length_m > longest_m ? Eigen::Vector3d{step * (longest_m / length_m)} : step;
}

} // namespace

template <int D>
NormalEquations<D> linearise(const Epoch& epoch, const Eigen::Vector3d& position_m) {
    const Sights sights = look(epoch, position_m);
    NormalEquations<D> normal;
    for (const Row& row : epoch.rows) {
        const Eigen::Vector4d sight = sights.col(row.b) - sights.col(row.a);
        normal.add(row.inverse_sigma * sight.head<D>(), row.inverse_sigma * (row.value_m - sight(3)));
    }
    if (epoch.correlation > 0) normal.correlate(epoch.correlation, static_cast<double>(epoch.rows.size()));
    return normal;
}

template <int D>
Minimum<D> refine(const Epoch& epoch, const Eigen::Vector3d& start_m, const Minimum<D>* known) {
    const double longest_m = longest_step_m(epoch);
    Eigen::Vector3d position_m = start_m;
    NormalEquations<D> here = linearise<D>(epoch, position_m);
    double damping = 0;
    bool converged = false;
    for (int i = 0; i < max_steps && !converged; ++i) {
        const Eigen::Vector3d step = damped_step(here, damping, longest_m);
        const NormalEquations<D> there = linearise<D>(epoch, position_m + step);
        converged = step.norm() < small_step_m;
        if (there.cost <= here.cost) {
            position_m += step;
            here = there;
            damping = damping > first_damping ? 0.1 * damping : 0;
            if (known && known->is_at(position_m)) return *known;
        } else {
            damping = std::max(10 * damping, first_damping);
        }
    }
    return {position_m, here.information, here.cost, converged};
}

template NormalEquations<2> linearise<2>(const Epoch&, const Eigen::Vector3d&);
template NormalEquations<3> linearise<3>(const Epoch&, const Eigen::Vector3d&);
template Minimum<2> refine<2>(const Epoch&, const Eigen::Vector3d&, const Minimum<2>*);
template Minimum<3> refine<3>(const Epoch&, const Eigen::Vector3d&, const Minimum<3>*);

} // namespace locus::uwb
