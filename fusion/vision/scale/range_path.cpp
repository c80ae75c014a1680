#include "fusion/vision/scale/range_path.h"

#include <algorithm>

namespace locus::vision {

void RangePath::clear() noexcept {
    waiting_.clear();
    open_.clear();
    here_ = {};
    has_begun_ = false;
}

void RangePath::hear(const uwb::Sighting& sighting, Timestamp time) noexcept {
    if (has_begun_ && waiting_.size() < most_waiting) waiting_.push_back({sighting, time});
}

bool RangePath::pass(const Eigen::Vector3d& position_odometry, Timestamp time, RangeRows& rows,
                     double together_odometry) noexcept {
    const RangeRow before = here_;
    const double gap_s = has_begun_ ? to_s(time - passed_) : 0;
    if (!has_begun_) opened_ = time;
    const Eigen::Vector3d way = position_odometry - before.position_odometry;
    const bool goes_on = gap_s > 0 && gap_s <= settings_.longest_gap_s;
    here_.position_odometry = position_odometry;
    here_.gone_odometry = has_begun_ ? before.gone_odometry + way.norm() : 0;
    here_.velocity_odometry_per_s = goes_on ? Eigen::Vector3d(way / gap_s) : Eigen::Vector3d::Zero();
    has_begun_ = true;
    passed_ = time;
    if (goes_on)
        for (const Waiting& heard : waiting_) lay(heard, before, gap_s);
    waiting_.clear();
    if (to_s(time - opened_) < settings_.window_s) return false;
    opened_ = time;
    return close_window(rows, together_odometry);
}

/// On the straight line from the pose before; an acceleration bends it by a t (gap - t) / 2.
void RangePath::lay(const Waiting& heard, const RangeRow& before, double gap_s) noexcept {
    const double left_s = std::clamp(to_s(passed_ - heard.time), 0.0, gap_s), share = left_s / gap_s;
    RangeRow row = here_;
    row.sighting = heard.sighting;
    row.position_odometry += share * (before.position_odometry - here_.position_odometry);
    row.gone_odometry += share * (before.gone_odometry - here_.gone_odometry);
    const double bent_m = 0.5 * settings_.acceleration_mps2 * left_s * (gap_s - left_s);
    const double noise_m2 = double{heard.sighting.sigma_m} * double{heard.sighting.sigma_m} + bent_m * bent_m;
    row.information_per_m2 = 1 / noise_m2;
    const auto same = std::find_if(open_.begin(), open_.end(), [&](const Open& o) { return o.row.is_of_same(row); });
    if (same != open_.end())
        same->row.join(row);
    else if (open_.size() < most_open)
        open_.push_back({row});
}

bool RangePath::close_window(RangeRows& rows, double together_odometry) noexcept {
    for (Open& open : open_) {
        const double held_m2 = settings_.held_sigma_m * settings_.held_sigma_m;
        open.row.information_per_m2 = 1 / (1 / open.row.information_per_m2 + held_m2);
        rows.add(open.row, together_odometry);
    }
    const bool grown = !open_.empty();
    open_.clear();
    return grown;
}

} // namespace locus::vision
