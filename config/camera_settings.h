// The keys of a camera's YAML calibration.
#pragma once

#include "fusion/option.h"

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace locus::config {

inline constexpr std::array<std::string_view, 3> camera_models{"pinhole", "fisheye", "homography"};
inline constexpr double unset = std::numeric_limits<double>::quiet_NaN();

struct CameraSettings {
    std::string model = "pinhole";
    std::uint32_t width_px = 0, height_px = 0;
    double fx_px = unset, fy_px = unset, cx_px = unset, cy_px = unset;
    double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0, k4 = 0, k5 = 0, k6 = 0;
    Vec3 rotation_vector_rad{unset, unset, unset}, translation_m{unset, unset, unset};
    Vec3 floor_x{unset, unset, unset}, floor_y{unset, unset, unset}, floor_w{unset, unset, unset};
};

namespace camera_rows {
template <auto Member>
constexpr OptionRow number(std::string_view name, std::string_view unit, double limit, std::string_view about) {
    return option<Member>(name, unit, -limit, limit, about);
}
} // namespace camera_rows

inline constexpr std::array camera_options{
    option<&CameraSettings::model>("model", "How pixels become rays.", camera_models),
    option<&CameraSettings::width_px>("width_px", "px", 1, 65536, "Of the images that it was calibrated with.", {},
                                      true),
    option<&CameraSettings::height_px>("height_px", "px", 1, 65536, "Of the images that it was calibrated with.", {},
                                       true),
    option<&CameraSettings::fx_px>("fx_px", "px", 1e-3, 1e6, "Focal length across."),
    option<&CameraSettings::fy_px>("fy_px", "px", 1e-3, 1e6, "Focal length upright."),
    camera_rows::number<&CameraSettings::cx_px>("cx_px", "px", 1e6,
                                                "Principal point, from the middle of the first pixel."),
    camera_rows::number<&CameraSettings::cy_px>("cy_px", "px", 1e6,
                                                "Principal point, from the middle of the first pixel."),
    camera_rows::number<&CameraSettings::k1>("k1", "", 1e3, "Radial distortion, as OpenCV's."),
    camera_rows::number<&CameraSettings::k2>("k2", "", 1e3, "Radial distortion, as OpenCV's."),
    camera_rows::number<&CameraSettings::p1>("p1", "", 1e3, "Tangential distortion, as OpenCV's (pinhole)."),
    camera_rows::number<&CameraSettings::p2>("p2", "", 1e3, "Tangential distortion, as OpenCV's (pinhole)."),
    camera_rows::number<&CameraSettings::k3>("k3", "", 1e3, "Radial distortion, as OpenCV's."),
    camera_rows::number<&CameraSettings::k4>("k4", "", 1e3,
                                             "Radial distortion, as OpenCV's; of a pinhole in the denominator."),
    camera_rows::number<&CameraSettings::k5>("k5", "", 1e3, "Radial distortion, as OpenCV's (pinhole, denominator)."),
    camera_rows::number<&CameraSettings::k6>("k6", "", 1e3, "Radial distortion, as OpenCV's (pinhole, denominator)."),
    camera_rows::number<&CameraSettings::rotation_vector_rad>(
        "rotation_vector_rad", "rad", 10, "OpenCV's rvec: turns the site's axes into the camera's."),
    camera_rows::number<&CameraSettings::translation_m>("translation_m", "m", 1e5,
                                                        "OpenCV's tvec: the site's origin in the camera's axes."),
    camera_rows::number<&CameraSettings::floor_x>("floor_x", "", 1e12,
                                                  "First row of the homography from pixels to the floor."),
    camera_rows::number<&CameraSettings::floor_y>("floor_y", "", 1e12, "Its second row."),
    camera_rows::number<&CameraSettings::floor_w>("floor_w", "", 1e12, "Its third row.")};

} // namespace locus::config
