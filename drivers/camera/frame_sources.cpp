#include "drivers/camera/frame_sources.h"

#include "drivers/camera/recorded_source.h"
#include "drivers/camera/v4l2_source.h"

#include <algorithm>
#include <array>

namespace locus::camera {

std::span<const FrameSourceRow> frame_source_table() {
    static const std::array rows{
        FrameSourceRow{
            "v4l2", "A camera on Video4Linux: USB cameras, MIPI cameras behind the kernel's drivers.",
            option_table<V4l2Settings>(v4l2_options),
            [](const void* settings) { return make_v4l2_source(*static_cast<const V4l2Settings*>(settings)); }, "path"},
        FrameSourceRow{
            "recorded",
            "A video file or a folder of images in place of a camera, for trying things out.",
            option_table<RecordedSettings>(recorded_options),
            [](const void* settings) { return make_recorded_source(*static_cast<const RecordedSettings*>(settings)); },
            {}},
    };
    return rows;
}

const FrameSourceRow* find_frame_source(std::string_view name) {
    const auto rows = frame_source_table();
    const auto row = std::ranges::find(rows, name, &FrameSourceRow::name);
    return row == rows.end() ? nullptr : &*row;
}

} // namespace locus::camera
