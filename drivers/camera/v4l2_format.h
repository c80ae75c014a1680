// Asks a camera for a size, pixel format and rate, and says in a sentence what it offers instead.
#pragma once

#include "drivers/camera/decode.h"
#include "drivers/camera/v4l2_device.h"
#include "drivers/camera/v4l2_settings.h"

#include <optional>

namespace locus::camera {

struct StreamFormat {
    PixelFormat format = PixelFormat::yuyv;
    int width_px = 0;
    int height_px = 0;
    int stride_bytes = 0;
    double rate_hz = 0; ///< as the driver says; 0: it does not
};

/// Empty, and a sentence in `error`, when the device offers nothing of what is wanted.
std::optional<StreamFormat> negotiate(V4l2Device& device, const V4l2Settings& settings, std::string& error);

} // namespace locus::camera
