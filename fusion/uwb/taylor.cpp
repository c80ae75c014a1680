#include "fusion/uwb/taylor.h"

#include "fusion/uwb/range_model.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace locus::uwb {
namespace {

constexpr int max_steps = 40;
/// Of cost. The step is a hundredth of a standard deviation: what it leaves is less, and nothing is linearised anew.
constexpr double small_gain = 1e-4;
constexpr double first_damping = 1e-3;

/// Gradient and, last, distance of every anchor; zero for no_anchor.
using Sights = Eigen::Matrix<double, 4, Eigen::Dynamic, Eigen::ColMajor, 4, Epoch::max_anchors>;

Sights look(const Epoch& epoch, const Eigen::Vector3d& position_m) {
    Sights sights(4, epoch.anchors_m.cols());
    sights.col(Epoch::no_anchor).setZero();
    for (int i = 1; i < epoch.anchors_m.cols(); ++i) {
        const Sight sight = sight_of(position_m, epoch.anchors_m.col(i));
        for (int axis = 0; axis < 3; ++axis) sights(axis, i) = sight.gradient(axis);
        sights(3, i) = sight.range_m;
    }
    return sights;
}

/// Element by element: what look() has just stored in single numbers must not be loaded in pairs, the processor would
/// wait for it.
template <int D>
typename NormalEquations<D>::Equation equation(const Row& row, const Sights& sights) {
    typename NormalEquations<D>::Equation equation;
    for (int i = 0; i < D; ++i) equation(i) = row.inverse_sigma * (sights(i, row.b) - sights(i, row.a));
    equation(D) = row.inverse_sigma * (row.value_m - (sights(3, row.b) - sights(3, row.a)));
    return equation;
}

/// No step is longer than the anchors stand apart: beyond, the linearisation says nothing.
double longest_step_m(const Epoch& epoch) { return epoch.real_anchors_m().colwise().norm().maxCoeff(); }

template <int D>
Eigen::Vector3d damped_step(const NormalEquations<D>& here, double damping, double longest_m) {
    Eigen::Matrix<double, D, D> damped = here.information();
    damped.diagonal().array() += damping * here.information().trace();
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    step.head<D>() = damped.inverse() * here.projection(); // eq. 11
    const double length_m = step.norm();
    return length_m > longest_m ? Eigen::Vector3d{step * (longest_m / length_m)} : step;
}

} // namespace

template <int D>
NormalEquations<D> linearise(const Epoch& epoch, const Eigen::Vector3d& position_m) {
    const Sights sights = look(epoch, position_m);
    return sum_of_rows<D>(epoch, [&](const Row& row) { return equation<D>(row, sights); });
}

template <int D>
Minimum<D> refine(const Epoch& epoch, const Eigen::Vector3d& start_m, const Minimum<D>* known) {
    const double longest_m = longest_step_m(epoch);
    Eigen::Vector3d position_m = start_m;
    NormalEquations<D> here = linearise<D>(epoch, position_m);
    double damping = 0;
    for (int i = 0; i < max_steps; ++i) {
        const Eigen::Vector3d step = damped_step(here, damping, longest_m);
        if (known && known->is_at(position_m + step)) return *known;
        if (std::abs(step.head<D>().dot(here.projection())) < small_gain)
            return {position_m + step, here.information(), here.cost(), true};
        const NormalEquations<D> there = linearise<D>(epoch, position_m + step);
        if (there.cost() < here.cost()) {
            position_m += step;
            here = there;
            damping = damping > first_damping ? 0.1 * damping : 0;
        } else {
            damping = std::max(10 * damping, first_damping);
        }
    }
    return {position_m, here.information(), here.cost(), false};
}

template NormalEquations<2> linearise<2>(const Epoch&, const Eigen::Vector3d&);
template NormalEquations<3> linearise<3>(const Epoch&, const Eigen::Vector3d&);
template Minimum<2> refine<2>(const Epoch&, const Eigen::Vector3d&, const Minimum<2>*);
template Minimum<3> refine<3>(const Epoch&, const Eigen::Vector3d&, const Minimum<3>*);

} // namespace locus::uwb
