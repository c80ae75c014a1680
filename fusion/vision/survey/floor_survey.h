// A camera's view of the floor from surveyed places: fitted, and each place checked against what the others say.
#pragma once

#include "fusion/vision/survey/floor_fit.h"

#include <optional>
#include <span>
#include <vector>

namespace locus::vision::survey {

enum class FloorTrouble {
    none,
    too_few,     ///< fewer than four
    in_one_line, ///< the places span no area
    mirrored,    ///< only a mirror shows them so
    not_told,    ///< they do not determine the view
};

/// Places nearer to one line than this share of their extent along it span no area: a third of the image's width at
/// most is then extrapolated twenty times.
inline constexpr double least_width_share = 0.05;

/// Standard deviations of the places about their mean, m: along the line that fits them, and across it.
Eigen::Vector2d extent_m(std::span<const Eigen::Vector2d> places_m);

struct FloorSurvey {
    FloorTrouble trouble = FloorTrouble::none;
    FloorFit fit;                     ///< its covariance is widened by widening^2
    double widening = 1;              ///< by how much residuals are larger than they should be; 1 if they are not
    int redundancy = 0;               ///< numbers measured more than needed
    std::vector<double> against_rest; ///< each place against the fit of the others: chi-square with two degrees of
                                      ///< freedom; NaN where the others alone tell nothing
    /// The place that fits the others worst; if these cannot be asked, the one with the largest residual.
    std::size_t worst = 0;
    bool is_worst_told = false; ///< its test stands out against all others'
};

/// Without a lens the view is a homography.
FloorSurvey survey_floor(std::span<const FloorPair> pairs, const std::optional<Lens>& lens);

/// Chi-square with two degrees of freedom, 99.9 %.
inline constexpr double worst_test = 13.8;

} // namespace locus::vision::survey
