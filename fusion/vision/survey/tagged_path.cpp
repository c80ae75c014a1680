#include "fusion/vision/survey/tagged_path.h"

#include <algorithm>

namespace locus::vision::survey {

std::optional<Eigen::Vector2d> TaggedPath::position_m(double time_s) const noexcept {
    const auto after = std::ranges::lower_bound(points_, time_s, {}, &PathPoint::time_s);
    if (after == points_.begin() || after == points_.end()) return std::nullopt;
    const PathPoint& from = *(after - 1);
    const double gap_s = after->time_s - from.time_s;
    if (gap_s > longest_gap_s) return std::nullopt;
    return from.site_m + (time_s - from.time_s) / gap_s * (after->site_m - from.site_m);
}

std::optional<TaggedPath::State> TaggedPath::at(double time_s) const noexcept {
    const auto site_m = position_m(time_s);
    if (!site_m) return std::nullopt;
    const auto before_m = position_m(time_s - velocity_base_s / 2), after_m = position_m(time_s + velocity_base_s / 2);
    if (!before_m || !after_m) return std::nullopt;
    return State{*site_m, (*after_m - *before_m) / velocity_base_s};
}

} // namespace locus::vision::survey
