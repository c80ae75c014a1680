// `locus calibrate camera chessboard`: images of a board in, a lens out, and how sure that is.
#pragma once

#include "drivers/camera/lens_fit.h"
#include "tools/calibrate/camera_file.h"

#include <string>
#include <vector>

namespace locus::calibrate {

struct BoardRequest {
    std::vector<std::string> images; ///< files, or one folder
    camera::BoardShape shape;
    bool is_fisheye = false;
};

/// Throws std::runtime_error where files cannot be used, CannotTell where they do not tell the lens.
CameraReport calibrate_lens(const BoardRequest& request);

} // namespace locus::calibrate
