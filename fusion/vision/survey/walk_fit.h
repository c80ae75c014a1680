// A camera calibrated by walking: one tagged person walks about, and the view of the floor and the offset between the
// camera's clock and the poses' are fitted together to where the person's feet were seen. Offline: it allocates.
#pragma once

#include "fusion/vision/survey/floor_fit.h"
#include "fusion/vision/survey/walk_start.h"

#include <optional>
#include <span>
#include <vector>

namespace locus::vision::survey {

enum class WalkTrouble {
    none,
    no_pose,  ///< hardly a foot was seen while there were poses
    nobody,   ///< nobody in the image walks as the poses do
    no_area,  ///< the places span no area: too straight or too small
    not_told, ///< the walk does not determine view and offset
};

/// A walk whose places spread less than so many times the poses' own error, in any direction, is a point or a line.
inline constexpr double least_spread_sigmas = 3;
/// A person whom the poses put into the image and who is seen in fewer of them is somebody else: with a view and an
/// offset to choose, half a minute of anybody's walk fits some piece of the poses (docs/cameras.md).
inline constexpr double least_seen_share = 0.4;
/// Nine numbers are fitted; twice as many feet that err each by itself.
inline constexpr double least_independent_feet = 20;
/// At a walker's pace that is more than the poses' own error.
inline constexpr double worst_offset_sigma_s = 0.25;

struct WalkFit {
    WalkTrouble trouble = WalkTrouble::none;
    FloorFit fit;        ///< residuals of the feet that were used; the covariance's last row is the offset's
    double offset_s = 0; ///< camera time + offset = time of the poses
    double offset_sigma_s = 0;
    double spread = 1;              ///< residuals as they are over what was expected of them, robustly
    double correlated_feet = 1;     ///< so many feet, one after the other, count as one
    std::vector<std::size_t> used;  ///< feet that were taken as the tagged person's
    std::size_t matched = 0;        ///< feet at a time with a pose
    double seen_share = 0;          ///< of the images in which the person should be seen: those in which he was
    Eigen::Vector2d extent_m{0, 0}; ///< standard deviations of the places used
};

/// Feet in any order; `lens` where it is known: then a camera is fitted, else a homography.
WalkFit fit_walk(std::span<const SeenFoot> feet, const TaggedPath& path, const std::optional<Lens>& lens,
                 const WalkSettings& settings);

} // namespace locus::vision::survey
