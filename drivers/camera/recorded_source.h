// A recorded video or a folder of images in place of a camera, with the stamps that its frame rate gives it, for
// development and replay.
#pragma once

#include "drivers/camera/frame_source.h"
#include "fusion/option.h"

#include <array>
#include <memory>
#include <optional>
#include <string>

namespace locus::camera {

struct RecordedSettings {
    std::string path;
    double rate_hz = 0;
    double speed = 1;
    bool loop = false;
};

inline constexpr std::array recorded_options{
    required_option<&RecordedSettings::path>("path",
                                             "Video file, or a folder of images, taken in order of their names."),
    option<&RecordedSettings::rate_hz>("rate_hz", "Hz", 0, 1000,
                                       "Frames a second; 0: what the file says of itself, 10 for a folder."),
    option<&RecordedSettings::speed>("speed", "", 0, 1000,
                                     "1: as it was recorded; 2: twice as fast; 0: as fast as possible, stamps spaced "
                                     "as recorded."),
    option<&RecordedSettings::loop>("loop", "Whether it starts again at its end."),
};

/// The first frame is captured at `start`; without one when it is opened.
std::unique_ptr<FrameSource> make_recorded_source(const RecordedSettings& settings,
                                                  std::optional<Timestamp> start = std::nullopt);

} // namespace locus::camera
