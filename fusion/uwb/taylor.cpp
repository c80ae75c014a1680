#include "fusion/uwb/taylor.h"

#include "fusion/uwb/range_model.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

namespace locus::uwb {
namespace {

constexpr int max_steps = 40;
/// Of cost. The step is three hundredths of a standard deviation: it is taken, what it leaves is some hundredth of that
/// (range noise over distance), and nothing is linearised anew.
constexpr double small_gain = 1e-3;
constexpr double first_damping = 1e-3;

/// One number for every anchor.
using PerAnchor = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, Epoch::max_anchors, 1>;

/// What range_model.h's sight_of() is for one anchor, for all of them: gradient and range, zero for no_anchor. In columns,
/// because square roots and divisions are most of the work and the processor takes them two at a time.
struct Sights {
    std::array<PerAnchor, 3> gradient;
    PerAnchor range_m;
};

void look(const Epoch& epoch, const Eigen::Vector3d& position_m, Sights& sights) {
    for (int axis = 0; axis < 3; ++axis)
        sights.gradient[axis] = position_m(axis) - epoch.anchors_m.row(axis).transpose().array();
    const auto& [x, y, z] = sights.gradient;
    sights.range_m = (x.square() + y.square() + z.square()).sqrt();
    const PerAnchor inverse = sights.range_m.max(on_anchor_m).inverse();
    for (PerAnchor& coordinate : sights.gradient) {
        coordinate *= inverse;
        coordinate(Epoch::no_anchor) = 0;
    }
    sights.range_m(Epoch::no_anchor) = 0;
}

/// Element by element: what comes from different places must not be loaded in pairs, the processor would wait for it.
template <int D>
typename NormalEquations<D>::Equation equation(const Row& row, const Sights& sights) {
    typename NormalEquations<D>::Equation equation;
    for (int i = 0; i < D; ++i)
        equation(i) = row.inverse_sigma * (sights.gradient[i](row.b) - sights.gradient[i](row.a));
    equation(D) = row.inverse_sigma * (row.value_m - (sights.range_m(row.b) - sights.range_m(row.a)));
    return equation;
}

/// The rows linearised at a position, eq. 9-10.
template <int D>
NormalEquations<D> linearise(const Epoch& epoch, const Eigen::Vector3d& position_m) {
    Sights sights;
    look(epoch, position_m, sights);
    return sum_of_rows<D>(epoch, [&](const Row& row) { return equation<D>(row, sights); });
}

/// No step is longer than the anchors stand apart: beyond, the linearisation says nothing.
double longest_step_m(const Epoch& epoch) { return epoch.real_anchors_m().colwise().norm().maxCoeff(); }

template <int D>
Eigen::Vector3d damped_step(const NormalEquations<D>& here, double damping, double longest_m) {
    Eigen::Matrix<double, D, D> damped = here.information();
    damped.diagonal().array() += damping * damped.trace();
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    step.head<D>() = damped.inverse() * here.projection(); // eq. 11
    const double length_m = step.norm();
    return length_m > longest_m ? Eigen::Vector3d{step * (longest_m / length_m)} : step;
}

} // namespace

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

template Minimum<2> refine<2>(const Epoch&, const Eigen::Vector3d&, const Minimum<2>*);
template Minimum<3> refine<3>(const Epoch&, const Eigen::Vector3d&, const Minimum<3>*);

} // namespace locus::uwb
