// A camera's calibration from its file: YAML of our own, whose numbers are those that OpenCV prints, or Tsai's model in
// the XML of the PETS recordings. What comes out is a view of the floor in the pixel axes of fusion/vision.
#pragma once

#include "config/problems.h"
#include "fusion/vision/camera_model.h"

#include <optional>
#include <string>
#include <string_view>

namespace locus::config {

struct CameraCalibration {
    vision::FloorView view;
    Eigen::Vector2d image_px{0, 0}; ///< size of the images that it was made with
};

/// A lens alone: of a camera that is not told yet where it hangs.
struct LensCalibration {
    vision::Lens lens;
    Eigen::Vector2d image_px{0, 0}; ///< size of the images that it was made with
};

/// XML when the first sign is '<'. Empty with at least one problem; never throws but std::bad_alloc.
std::optional<CameraCalibration> parse_camera(std::string_view text, Problems& problems);

/// As YAML (docs/cameras.md has the keys).
std::optional<CameraCalibration> parse_camera_yaml(std::string_view text, Problems& problems);

/// <Camera> with <Geometry>, <Intrinsic> and <Extrinsic>, lengths in mm, angles in rad about x, then y, then z.
std::optional<CameraCalibration> parse_tsai_xml(std::string_view text, Problems& problems);

/// A file's; empty with a problem for each thing that is wrong.
std::optional<CameraCalibration> load_camera(const std::string& path, std::vector<ConfigProblem>& problems);

/// The lens of a YAML file of model pinhole or fisheye; what it says of the camera's place is passed over.
std::optional<LensCalibration> parse_lens(std::string_view text, Problems& problems);
std::optional<LensCalibration> load_lens(const std::string& path, std::vector<ConfigProblem>& problems);

/// For images of another size than the calibration's: cameras are calibrated at one and run at another.
vision::FloorView view_for(const CameraCalibration& calibration, const Eigen::Vector2d& image_px) noexcept;

} // namespace locus::config
