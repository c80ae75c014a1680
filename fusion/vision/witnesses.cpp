#include "fusion/vision/witnesses.h"

#include "fusion/vision/anonymous.h"

#include <algorithm>

namespace locus::vision {
namespace {

/// By how much the velocity of somebody who walks wanders, m/s per root of a second: that of the default estimator.
constexpr double velocity_walk = 1.3;

/// Where it was `dt_s` >= 0 before. The entries of a 6 x 6 covariance of position and velocity, row by row.
LocatedTag some_time_before(const Estimate& estimate, double dt_s, Address tag) {
    LocatedTag located;
    located.tag = tag;
    const auto p = [&](std::size_t row, std::size_t column) { return estimate.covariance[6 * row + column]; };
    const double walked_m2 = velocity_walk * velocity_walk * dt_s * dt_s * dt_s / 3;
    for (std::size_t i = 0; i < 2; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        located.position_site_m(row) = estimate.position_site_m[i] - dt_s * estimate.velocity_site_mps[i];
        for (std::size_t j = 0; j < 2; ++j)
            located.covariance_m2(row, static_cast<Eigen::Index>(j)) =
                p(i, j) - dt_s * (p(i, 3 + j) + p(3 + i, j)) + dt_s * dt_s * p(3 + i, 3 + j) + (i == j ? walked_m2 : 0);
    }
    return located;
}

} // namespace

Witnesses::Witnesses(const TargetTable& targets, bool cameras) : targets_(targets), unread_(Site{}) {
    if (!cameras) return;
    timelines_.reserve(targets.room());
    for (std::size_t slot = 0; slot < targets.room(); ++slot) timelines_.push_back(targets.timeline(slot).blank());
    located_.reserve(targets.room());
}

void Witnesses::hear(TargetTable::Slot slot, const Measurement& measurement, const SampleKey& key) noexcept {
    if (!timelines_.empty()) timelines_[slot].insert(measurement, key, {});
}

void Witnesses::run(Timestamp tick, Timestamp horizon) noexcept {
    tick_ = tick;
    for (std::size_t slot = 0; slot < std::min(timelines_.size(), targets_.size()); ++slot)
        timelines_[slot].run(tick, horizon, unread_);
}

std::span<const LocatedTag> Witnesses::locate(Timestamp time) noexcept {
    located_.clear();
    for (std::size_t slot = 0; slot < std::min(timelines_.size(), targets_.size()); ++slot) {
        if (is_anonymous(targets_.address(slot))) continue;
        const Estimate estimate = timelines_[slot].predict(tick_);
        if (estimate.missing != Missing::nothing) continue;
        located_.push_back(some_time_before(estimate, std::max(0.0, to_s(tick_ - time)), targets_.address(slot)));
    }
    return located_;
}

} // namespace locus::vision
