// What an installer can say of a camera on V4L2.
#pragma once

#include "fusion/option.h"

#include <array>
#include <string>

namespace locus::camera {

inline constexpr std::array<std::string_view, 5> wanted_format_names{"any", "yuyv", "nv12", "mjpeg", "grey"};

/// Size: what every USB camera offers. Exposure and delay 0: the driver's stamp is taken as it is; a data sheet or
/// `locus calibrate` knows better.
struct V4l2Settings {
    std::string path;
    int width_px = 640;
    int height_px = 480;
    std::string pixel_format = "any";
    double rate_hz = 0;
    double exposure_s = 0;
    double delay_s = 0;
    double silence_s = 2;
};

inline constexpr std::array v4l2_options{
    required_option<&V4l2Settings::path>("path", "Device; a name of /dev/v4l/by-id/ stays the same when replugged."),
    option<&V4l2Settings::width_px>("width_px", "px", 16, 8192, "Width; the camera must offer exactly this size."),
    option<&V4l2Settings::height_px>("height_px", "px", 16, 8192, "Height."),
    option<&V4l2Settings::pixel_format>(
        "pixel_format", "any: the first of yuyv, nv12, mjpeg, grey that is offered at this size and rate.",
        wanted_format_names),
    option<&V4l2Settings::rate_hz>("rate_hz", "Hz", 0, 1000, "Frames a second; 0: as the camera likes."),
    option<&V4l2Settings::exposure_s>("exposure_s", "s", 0, 10,
                                      "Exposure time: half of it is put on a stamp of the exposure's start, or taken "
                                      "off one of its end, as the driver says which it gives."),
    option<&V4l2Settings::delay_s>("delay_s", "s", -1, 10,
                                   "Taken off every stamp: readout and whatever else the driver does not know."),
    option<&V4l2Settings::silence_s>("silence_s", "s", 0.1, 60,
                                     "Without a frame for so long the camera counts as lost and is opened again."),
};

} // namespace locus::camera
