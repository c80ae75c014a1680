// A camera that stands somewhere and looks at a floor: from a pixel to the place on the floor where somebody stands,
// with the covariance that the pixel's own gives there, and from a place in the site to a pixel.
#pragma once

#include "fusion/vision/lens.h"

#include <Eigen/Geometry>

#include <optional>
#include <variant>

namespace locus::vision {

/// x_camera = camera_from_site x_site + site_in_camera_m (paper 000 eq. 26).
struct Camera {
    Lens lens;
    Eigen::Matrix3d camera_from_site = Eigen::Matrix3d::Identity(); ///< a rotation
    Eigen::Vector3d site_in_camera_m = Eigen::Vector3d::Zero();

    Eigen::Vector3d position_site_m() const { return -camera_from_site.transpose() * site_in_camera_m; }
};

/// All that is known of a camera whose floor was surveyed but not its lens: (x, y, 1) ~ floor_from_pixel (u, v, 1).
/// The third component is positive on the side of the horizon that shows the floor.
struct FloorHomography {
    Eigen::Matrix3d floor_from_pixel = Eigen::Matrix3d::Identity();
};

/// The sign is chosen so that `seen_px` lies below the horizon.
FloorHomography floor_homography(const Eigen::Matrix3d& floor_from_pixel, const Eigen::Vector2d& seen_px) noexcept;

using FloorView = std::variant<Camera, FloorHomography>;

struct FloorPoint {
    Eigen::Vector2d position_site_m;
    Eigen::Matrix2d covariance_m2;
};

struct PixelPoint {
    Eigen::Vector2d pixel_px;
    Eigen::Matrix2d covariance_px2;
};

/// A person's height over the floor, as far as it is known.
struct BodyHeight {
    double height_m = 1.7;
    double sigma_m = 0.1;
};

/// Where on the floor (z = 0) somebody stands whose feet are seen at `foot`. Empty at and above the horizon.
std::optional<FloorPoint> foot_on_floor(const FloorView& view, const PixelPoint& foot) noexcept;

/// The same from the head when the feet are hidden: on the plane at the body's height, whose doubt comes in along the
/// line of sight. Empty for a homography, which knows of the floor only, and where the head is above the horizon of
/// that plane.
std::optional<FloorPoint> foot_below_head(const FloorView& view, const PixelPoint& head,
                                          const BodyHeight& body) noexcept;

/// The pixel of a place on the floor. Empty when it is not in front of the camera.
std::optional<Eigen::Vector2d> pixel_of_floor(const FloorView& view, const Eigen::Vector2d& position_site_m) noexcept;

/// The pixel of a place in the site and its derivative by the place (not by the ray).
std::optional<Sight> look_at(const Camera& camera, const Eigen::Vector3d& position_site_m) noexcept;

/// The same view in an image that was made `factor` times as wide and high.
FloorView scaled(const FloorView& view, const Eigen::Vector2d& factor) noexcept;

} // namespace locus::vision
