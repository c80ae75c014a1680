// The sources that settings can name.
#pragma once

#include "drivers/camera/frame_source.h"
#include "fusion/option.h"

#include <memory>
#include <span>
#include <string_view>

namespace locus::camera {

struct FrameSourceRow {
    std::string_view name;
    std::string_view about;
    OptionTable options;
    std::unique_ptr<FrameSource> (*make)(const void* settings);
    std::string_view sole_option; ///< names a device that only one can have open
};

std::span<const FrameSourceRow> frame_source_table();
const FrameSourceRow* find_frame_source(std::string_view name);

} // namespace locus::camera
