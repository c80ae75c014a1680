// A camera on Video4Linux: streaming through buffers that the driver shares (mmap).
#pragma once

#include "drivers/camera/frame_source.h"
#include "drivers/camera/v4l2_device.h"
#include "drivers/camera/v4l2_settings.h"

#include <memory>

namespace locus::camera {

std::unique_ptr<FrameSource> make_v4l2_source(const V4l2Settings& settings,
                                              std::unique_ptr<V4l2Device> device = make_v4l2_device());

} // namespace locus::camera
