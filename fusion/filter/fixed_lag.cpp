#include "fusion/filter/fixed_lag.h"

#include <Eigen/Cholesky>

namespace locus::filter {
namespace {

Eigen::Matrix<double, 6, 1> way_of(const Estimate& estimate) {
    Eigen::Matrix<double, 6, 1> state;
    for (int i = 0; i < 3; ++i) {
        state(i) = estimate.position_site_m[i];
        state(i + 3) = estimate.velocity_site_mps[i];
    }
    return state;
}

Eigen::Matrix<double, 6, 6> spread_of(const Estimate& estimate) {
    return Eigen::Map<const Eigen::Matrix<double, 6, 6>>(estimate.covariance.data());
}

bool follows(const Estimate& before, const Estimate& after) {
    return before.missing == Missing::nothing && after.missing == Missing::nothing &&
           before.reset_count == after.reset_count && before.time < after.time;
}

} // namespace

void FixedLag::add(const Estimate& filtered, const Estimate& foreseen) noexcept {
    if (filtered.missing != Missing::nothing) return nodes_.clear();
    Node node{filtered};
    if (!nodes_.empty() && follows(nodes_.back().filtered, filtered) && follows(nodes_.back().filtered, foreseen)) {
        node.foreseen = way_of(foreseen);
        node.foreseen_covariance = spread_of(foreseen);
        const double dt_s = to_s(filtered.time - nodes_.back().filtered.time);
        Matrix6 moved = spread_of(nodes_.back().filtered); // F P, transposed below
        moved.topRows<3>() += dt_s * moved.bottomRows<3>().eval();
        const Eigen::LDLT<Matrix6> solver(node.foreseen_covariance);
        node.gain = solver.solve(moved).transpose();
        if (!node.gain.allFinite()) node.gain.setZero();
    } else {
        nodes_.clear();
    }
    nodes_.push_back(node);
}

std::optional<Estimate> FixedLag::smoothed() const noexcept {
    if (!nodes_.full()) return {};
    Vector6 state = way_of(nodes_.back().filtered);
    Matrix6 covariance = spread_of(nodes_.back().filtered);
    for (std::size_t i = nodes_.size() - 1; i > 0; --i) {
        const Node& after = nodes_[i];
        const Estimate& before = nodes_[i - 1].filtered;
        state = way_of(before) + after.gain * (state - after.foreseen);
        covariance = spread_of(before) + after.gain * (covariance - after.foreseen_covariance) * after.gain.transpose();
    }
    Estimate estimate = nodes_.front().filtered;
    for (int i = 0; i < 3; ++i) {
        estimate.position_site_m[i] = state(i);
        estimate.velocity_site_mps[i] = state(i + 3);
    }
    Eigen::Map<Matrix6>(estimate.covariance.data()) = 0.5 * (covariance + covariance.transpose());
    return estimate;
}

} // namespace locus::filter
