// A lens from pictures of a chessboard: OpenCV's calibration (Zhang 2000; for a fisheye Kannala and Brandt 2006), and
// how sure each number of it is.
#pragma once

#include "drivers/camera/chessboard.h"
#include "fusion/vision/lens.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace locus::camera {

struct LensParameter {
    std::string name; ///< as in a calibration's YAML; the centre counts from the middle of the first pixel
    double value = 0;
    double sigma = 0; ///< from what is left of the corners, as if they erred independently
};

struct BoardFit {
    double rms_px = 0;                         ///< of its corners
    Eigen::Vector3d normal_in_camera{0, 0, 1}; ///< of unit length
};

struct LensFit {
    vision::Lens lens;
    double rms_px = 0; ///< of all corners, both axes together
    std::vector<LensParameter> parameters;
    std::vector<BoardFit> boards;
};

/// Of a pinhole k1, k2, p1, p2, and k3 where it is larger than three of its sigmas: else it only bends what lies
/// outside of the boards. Empty, with a sentence in `error`, where OpenCV finds no lens.
std::optional<LensFit> fit_lens(std::span<const BoardCorners> boards, const BoardShape& shape,
                                const Eigen::Vector2d& image_px, bool is_fisheye, std::string& error);

} // namespace locus::camera
