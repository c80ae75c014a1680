// An image file as a picture.
#pragma once

#include "drivers/camera/picture.h"

#include <optional>
#include <string>

namespace locus::camera {

/// Empty, with a sentence in `error`, where there is none or it cannot be read.
std::optional<Picture> read_picture(const std::string& path, std::string& error);

} // namespace locus::camera
