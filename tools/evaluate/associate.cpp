#include "tools/evaluate/associate.h"

#include <algorithm>

namespace locus::evaluate {

namespace {

Eigen::Vector3d interpolate(const TrackPoint& before, const TrackPoint& after, double time_s) {
    const double part = (time_s - before.time_s) / (after.time_s - before.time_s);
    return before.position_m + part * (after.position_m - before.position_m);
}

bool selected(const Pair& pair, const Selection& selection) {
    return pair.time_s >= selection.from_s && pair.time_s <= selection.to_s &&
           pair.truth_m.z() >= selection.min_truth_z_m;
}

void add(Association& result, const Track& truth, const TrackPoint& estimate, const Selection& selection) {
    const auto after = std::ranges::lower_bound(truth, estimate.time_s, {}, &TrackPoint::time_s);
    const bool exact = after != truth.end() && after->time_s == estimate.time_s;
    if (!exact && (after == truth.begin() || after == truth.end())) {
        ++result.outside_truth;
        return;
    }
    const auto before = exact ? after : after - 1;
    if (after->time_s - before->time_s > selection.max_gap_s) {
        ++result.in_gap;
        return;
    }
    const Pair pair{estimate.time_s, exact ? after->position_m : interpolate(*before, *after, estimate.time_s),
                    estimate.position_m, estimate.horizontal_bound_m, estimate.vertical_bound_m};
    if (selected(pair, selection))
        result.pairs.push_back(pair);
    else
        ++result.not_selected;
}

} // namespace

Association associate(const Track& truth, const Track& estimate, const Selection& selection) {
    Association result;
    for (const auto& point : estimate) add(result, truth, point, selection);
    return result;
}

} // namespace locus::evaluate
