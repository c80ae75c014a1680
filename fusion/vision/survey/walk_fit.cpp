#include "fusion/vision/survey/walk_fit.h"

#include "fusion/uwb/survey/correlation.h"
#include "fusion/vision/survey/floor_survey.h"
#include "fusion/vision/survey/walk_rounds.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace locus::vision::survey {
namespace {

/// Residuals come in the feet's order; those of one track hang together in time.
double correlated(const Walking& walking) {
    double most = 1;
    for (int axis = 0; axis < 2; ++axis) {
        std::vector<double> series;
        for (const TimedPair& pair : walking.pairs)
            series.push_back(residual_of(walking.view, pair).error_px[axis] / pair.sigma_px);
        most = std::max(most, uwb::survey::correlated_samples(series));
    }
    return most;
}

void tell(WalkFit& out, const Walking& walking) {
    const NormalEquations normal = normal_equations(walking.view, walking.pairs, walking.centre_m, true);
    out.fit.view = walking.view;
    out.fit.centre_m = walking.centre_m;
    out.fit.is_told = is_determined(normal.information);
    out.correlated_feet = correlated(walking);
    out.fit.covariance = out.correlated_feet * normal.information.inverse();
    for (const TimedPair& pair : walking.pairs) out.fit.residuals.push_back(residual_of(walking.view, pair));
    out.offset_s = walking.offset_s;
    out.offset_sigma_s = std::sqrt(std::max(out.fit.covariance.bottomRightCorner<1, 1>().value(), 0.));
    out.spread = walking.spread;
    out.used = walking.used;
}

/// Of the images, as far as anybody was seen in them, that should show the person by poses and view.
double seen_share(const Walking& walking, std::span<const SeenFoot> feet, const TaggedPath& path,
                  const Eigen::Vector2d& image_px) {
    std::vector<double> times_s;
    for (const SeenFoot& foot : feet) times_s.push_back(foot.time_s);
    std::ranges::sort(times_s);
    times_s.erase(std::unique(times_s.begin(), times_s.end()), times_s.end());
    const auto shows = [&](double time_s) {
        const auto there = path.at(time_s + walking.offset_s);
        const auto pixel = there ? pixel_of_floor(walking.view, there->site_m) : std::nullopt;
        return pixel && (pixel->array() > 0).all() && (pixel->array() < image_px.array()).all();
    };
    const auto expected = std::ranges::count_if(times_s, shows);
    return expected > 0 ? static_cast<double>(walking.used.size()) / static_cast<double>(expected) : 0;
}

Eigen::Vector2d extent_of(const std::vector<TimedPair>& pairs) {
    std::vector<Eigen::Vector2d> places_m;
    for (const TimedPair& pair : pairs) places_m.push_back(pair.site_m);
    return extent_m(places_m);
}

bool is_wide_enough(const Eigen::Vector2d& extent_m, const WalkSettings& settings) {
    return extent_m.y() >= least_spread_sigmas * settings.pose_sigma_m;
}

} // namespace

WalkFit fit_walk(std::span<const SeenFoot> feet, const TaggedPath& path, const std::optional<Lens>& lens,
                 const WalkSettings& settings) {
    WalkFit out;
    const auto refused = [&](WalkTrouble trouble) {
        out.trouble = trouble;
        return out;
    };
    const Matched at_zero =
        match(feet, path, 0.5 * (settings.least_offset_s + settings.most_offset_s), settings.pose_sigma_m);
    out.matched = at_zero.pairs.size();
    out.extent_m = extent_of(at_zero.pairs);
    const auto starts = start_walk(feet, path, lens, settings);
    if (out.matched >= least_feet && !is_wide_enough(out.extent_m, settings)) return refused(WalkTrouble::no_area);
    if (starts.empty()) return refused(out.matched < least_feet ? WalkTrouble::no_pose : WalkTrouble::nobody);
    std::optional<Walking> best;
    for (const WalkStart& start : starts)
        if (Walking walking = walked_from(start, feet, path, settings);
            walking.used.size() >= least_feet && (!best || walking.cost < best->cost))
            best = std::move(walking);
    if (!best) return refused(WalkTrouble::nobody);
    out.matched = match(feet, path, best->offset_s, settings.pose_sigma_m).pairs.size();
    out.extent_m = extent_of(best->pairs);
    tell(out, *best);
    out.seen_share = seen_share(*best, feet, path, settings.image_px);
    if (!is_wide_enough(out.extent_m, settings)) return refused(WalkTrouble::no_area);
    if (out.seen_share < least_seen_share) return refused(WalkTrouble::nobody);
    if (static_cast<double>(out.used.size()) < least_independent_feet * out.correlated_feet)
        return refused(WalkTrouble::not_told);
    const bool is_good =
        out.fit.is_told && out.offset_sigma_s < worst_offset_sigma_s && is_seen_from_above(out.fit.view);
    return is_good ? out : refused(WalkTrouble::not_told);
}

} // namespace locus::vision::survey
