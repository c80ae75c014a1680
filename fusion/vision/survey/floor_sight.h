// How a view of the floor shows a place, and how the pixel moves with the place and with the view itself: what a least
// squares fit of a view needs.
#pragma once

#include "fusion/vision/camera_model.h"

#include <Eigen/Core>

#include <optional>

namespace locus::vision::survey {

inline constexpr int most_view_parameters = 8;

using ViewStep = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_view_parameters, 1>;
using ByView = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, most_view_parameters>;

struct FloorSight {
    Eigen::Vector2d pixel_px;
    Eigen::Matrix2d by_floor; ///< px/m
    ByView by_view;           ///< by the step of moved()
};

/// 6 of a camera whose lens is known: a turn and a shift, rad and m, in its own axes. 8 of a homography.
int view_parameters(const FloorView& view) noexcept;

/// Steps of a homography change the floor before it is looked at, about `centre_m`: x' ~ (I + E) x, the last element of
/// E zero. Empty where the place is not in front of the camera.
std::optional<FloorSight> sight_of(const FloorView& view, const Eigen::Vector2d& site_m,
                                   const Eigen::Vector2d& centre_m) noexcept;

FloorView moved(const FloorView& view, const ViewStep& step, const Eigen::Vector2d& centre_m) noexcept;

/// False for a view that shows the floor from below, or as a mirror does: x and y were swapped, or y was counted
/// downwards.
bool is_seen_from_above(const FloorView& view) noexcept;

} // namespace locus::vision::survey
