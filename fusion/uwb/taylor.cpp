#include "fusion/uwb/taylor.h"

#include "fusion/uwb/range_model.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace locus::uwb {
namespace {

constexpr int max_steps = 40;
/// Of cost. The step is three hundredths of a standard deviation: it is taken, what it leaves is some hundredth of that
/// (range noise over distance), and nothing is linearised anew.
constexpr double small_gain = 1e-3;
constexpr double first_damping = 1e-3;

/// As seen from a position: the direction to every anchor and, last, its distance; zero for no_anchor.
using Sights = Eigen::Matrix<double, 4, Eigen::Dynamic, Eigen::ColMajor, 4, Epoch::max_anchors>;
/// What every row measured, where Sights have the distance. Kept in fours like them: numbers that were stored one by
/// one and are loaded in pairs make the processor wait.
using Values = Eigen::Matrix<double, 4, Eigen::Dynamic, Eigen::ColMajor, 4, static_cast<int>(max_observations)>;

void look(const Epoch& epoch, const Eigen::Vector3d& position_m, Sights& sights) {
    sights.resize(4, epoch.anchors_m.cols());
    sights.col(Epoch::no_anchor).setZero();
    for (int i = 1; i < epoch.anchors_m.cols(); ++i) {
        const Sight sight = sight_of(position_m, epoch.anchors_m.col(i));
        for (int axis = 0; axis < 3; ++axis) sights(axis, i) = -sight.gradient(axis);
        sights(3, i) = sight.range_m;
    }
}

Values values_of(const Epoch& epoch) {
    Values values = Values::Zero(4, epoch.rows.size());
    for (std::size_t i = 0; i < epoch.rows.size(); ++i) values(3, i) = epoch.rows[i].value_m;
    return values;
}

/// The rows linearised at a position, eq. 9-10.
template <int D>
NormalEquations<D> linearise(const Epoch& epoch, const Values& values, const Eigen::Vector3d& position_m) {
    Sights sights;
    look(epoch, position_m, sights);
    return sum_of_rows<D>(epoch, [&](const Row& row) -> typename NormalEquations<D>::Equation {
        const Eigen::Vector4d full =
            row.inverse_sigma * (values.col(&row - epoch.rows.data()) - (sights.col(row.b) - sights.col(row.a)));
        if constexpr (D == 3)
            return typename NormalEquations<D>::Equation(full);
        else
            return {full(0), full(1), full(3)};
    });
}

/// No step is longer than the anchors stand apart: beyond, the linearisation says nothing.
double longest_step_m(const Epoch& epoch) {
    return std::sqrt(epoch.real_anchors_m().colwise().squaredNorm().maxCoeff());
}

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
    const Values values = values_of(epoch);
    Eigen::Vector3d position_m = start_m;
    NormalEquations<D> here = linearise<D>(epoch, values, position_m);
    double damping = 0;
    for (int i = 0; i < max_steps; ++i) {
        const Eigen::Vector3d step = damped_step(here, damping, longest_m);
        if (known && known->is_at(position_m + step)) return *known;
        if (std::abs(step.head<D>().dot(here.projection())) < small_gain)
            return {position_m + step, here.information(), here.cost(), true};
        const NormalEquations<D> there = linearise<D>(epoch, values, position_m + step);
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
