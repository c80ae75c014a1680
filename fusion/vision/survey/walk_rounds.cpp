#include "fusion/vision/survey/walk_rounds.h"

#include "fusion/vision/survey/floor_survey.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>

namespace locus::vision::survey {
namespace {

constexpr std::size_t least_feet_of_track = 5;
constexpr double median_test = 1.386; ///< of chi-square with two degrees of freedom
/// Beyond these it is luck, or the wrong person.
constexpr double smallest_spread = 0.3, largest_spread = 5;
constexpr int most_rounds = 30;

void scale(Matched& matched, double spread) {
    for (TimedPair& pair : matched.pairs) {
        pair.sigma_m *= spread;
        pair.sigma_px *= spread;
    }
}

/// Feet that fit, of tracks most of whose feet fit: a stranger crosses the path now and then, and is left out whole.
void choose(Walking& walking, const Matched& matched, std::span<const SeenFoot> feet) {
    std::map<std::uint32_t, std::pair<std::size_t, std::size_t>> fit_of; // feet that fit, and all of a track
    std::vector<bool> fits;
    for (std::size_t i = 0; i < matched.pairs.size(); ++i) {
        const Residual residual = residual_of(walking.view, matched.pairs[i]);
        fits.push_back(residual.is_seen && residual.test < worst_test);
        auto& [good, all] = fit_of[feet[matched.feet[i]].track];
        good += fits.back();
        ++all;
    }
    walking.used.clear();
    walking.pairs.clear();
    for (std::size_t i = 0; i < matched.pairs.size(); ++i) {
        const auto [good, all] = fit_of[feet[matched.feet[i]].track];
        if (!fits[i] || good < least_feet_of_track || 2 * good < all) continue;
        walking.used.push_back(matched.feet[i]);
        walking.pairs.push_back(matched.pairs[i]);
    }
    walking.centre_m = centre_of(walking.pairs);
}

/// Of the feet used, against what their sigmas (without the spread of before) make expect.
double spread_of(const Walking& walking) {
    std::vector<double> tests;
    for (const TimedPair& pair : walking.pairs) tests.push_back(residual_of(walking.view, pair).test);
    const auto middle = tests.begin() + static_cast<std::ptrdiff_t>(tests.size() / 2);
    std::ranges::nth_element(tests, middle);
    return std::clamp(walking.spread * std::sqrt(*middle / median_test), smallest_spread, largest_spread);
}

/// One Gauss-Newton step of view and offset; how large it was against its own standard deviation.
double step(Walking& walking) {
    const NormalEquations normal = normal_equations(walking.view, walking.pairs, walking.centre_m, true);
    Eigen::MatrixXd damped = normal.information;
    damped.diagonal() *= 1 + 1e-6;
    const Eigen::VectorXd move = damped.ldlt().solve(normal.gradient);
    if (!move.allFinite()) return 0;
    walking.view = moved(walking.view, ViewStep(move.head(move.size() - 1)), walking.centre_m);
    walking.offset_s += move[move.size() - 1];
    return std::sqrt(std::max(move.dot(normal.gradient), 0.));
}

} // namespace

Walking walked_from(const WalkStart& start, std::span<const SeenFoot> feet, const TaggedPath& path,
                    const WalkSettings& settings) {
    Walking walking{start.view, start.offset_s};
    for (int round = 0; round < most_rounds; ++round) {
        Matched matched = match(feet, path, walking.offset_s, settings.pose_sigma_m);
        scale(matched, walking.spread);
        choose(walking, matched, feet);
        if (walking.used.size() < least_feet) break;
        walking.spread = spread_of(walking);
        if (step(walking) < 1e-3 && round > 5) break;
    }
    const Matched matched = match(feet, path, walking.offset_s, settings.pose_sigma_m);
    walking.cost =
        matched.pairs.empty() ? stranger_cost(settings) : cost_of_view(walking.view, matched, feet.size(), settings);
    return walking;
}

} // namespace locus::vision::survey
