// Lenses: from a ray in the camera's axes to a pixel and back. Three models, for these are what people's calibrations
// come in: OpenCV's pinhole, OpenCV's fisheye (Kannala and Brandt), and Tsai's with its one radial coefficient. Camera
// axes: x to the right, y down, z forward. Pixel axes: those of BoxPx, from the corner of the upper left pixel; OpenCV
// and Tsai count from its centre, so whoever reads their files adds half a pixel to the principal point.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <optional>
#include <variant>

namespace locus::vision {

/// A point as a lens shows it, and how the pixel moves with the ray's three components.
struct Sight {
    Eigen::Vector2d pixel_px;
    Eigen::Matrix<double, 2, 3> by_ray;
};

/// OpenCV manual, "Camera Calibration and 3D Reconstruction", detailed description.
struct PinholeLens {
    Eigen::Vector2d focal_px{1, 1};
    Eigen::Vector2d centre_px{0, 0};
    std::array<double, 6> radial{};     ///< k1 ... k6; the last three stand in the denominator
    std::array<double, 2> tangential{}; ///< p1, p2
};

/// Kannala and Brandt, "A generic camera model ...", 2006, as OpenCV's fisheye module has it.
struct FisheyeLens {
    Eigen::Vector2d focal_px{1, 1};
    Eigen::Vector2d centre_px{0, 0};
    std::array<double, 4> radial{}; ///< k1 ... k4, of the angle from the axis
};

/// Tsai, "A versatile camera calibration technique ...", 1987, eq. 5-8: undistorted = distorted (1 + kappa1 r^2) on the
/// sensor, r of the distorted point.
struct TsaiLens {
    double focal_mm = 1;
    double kappa1_per_mm2 = 0;
    Eigen::Vector2d pitch_mm{1, 1}; ///< of a pixel on the sensor; across with Tsai's factor sx taken in: dpx / sx
    Eigen::Vector2d centre_px{0, 0};
};

using Lens = std::variant<PinholeLens, FisheyeLens, TsaiLens>;

/// Empty where the lens shows nothing: behind it, or where its polynomial turns back and would fold the far outside
/// into the image. The ray may have any length.
std::optional<Sight> project(const Lens& lens, const Eigen::Vector3d& ray) noexcept;

/// The ray of a pixel, of unit length; empty where no ray is found in a bounded number of steps.
std::optional<Eigen::Vector3d> unproject(const Lens& lens, const Eigen::Vector2d& pixel_px) noexcept;

/// The same lens in an image that was made `factor` times as wide and high.
Lens scaled(const Lens& lens, const Eigen::Vector2d& factor) noexcept;

} // namespace locus::vision
