#include "config/camera_text.h"

#include "config/camera_settings.h"
#include "config/value.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <tuple>

namespace locus::config {
namespace {

using vision::FisheyeLens;
using vision::PinholeLens;

Vec3 plain(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

void set_size(CameraSettings& s, const Eigen::Vector2d& image_px) {
    s.width_px = static_cast<std::uint32_t>(image_px.x());
    s.height_px = static_cast<std::uint32_t>(image_px.y());
}

/// OpenCV counts pixels from the middle of the first one.
constexpr double half_a_pixel = 0.5;

template <class Model>
void set_axes(CameraSettings& s, const Model& lens) {
    s.fx_px = lens.focal_px.x();
    s.fy_px = lens.focal_px.y();
    s.cx_px = lens.centre_px.x() - half_a_pixel;
    s.cy_px = lens.centre_px.y() - half_a_pixel;
}

/// False for Tsai's.
bool set_lens(CameraSettings& s, const vision::Lens& lens) {
    if (const auto* fisheye = std::get_if<FisheyeLens>(&lens)) {
        s.model = "fisheye";
        set_axes(s, *fisheye);
        std::tie(s.k1, s.k2, s.k3, s.k4) = std::tuple_cat(fisheye->radial);
    } else if (const auto* pinhole = std::get_if<PinholeLens>(&lens)) {
        s.model = "pinhole";
        set_axes(s, *pinhole);
        std::tie(s.k1, s.k2, s.k3, s.k4, s.k5, s.k6) = std::tuple_cat(pinhole->radial);
        std::tie(s.p1, s.p2) = std::tuple_cat(pinhole->tangential);
    } else
        return false;
    return true;
}

bool set_view(CameraSettings& s, const vision::FloorView& view) {
    if (const auto* camera = std::get_if<vision::Camera>(&view)) {
        const Eigen::AngleAxisd turn(camera->camera_from_site);
        s.rotation_vector_rad = plain(turn.angle() * turn.axis());
        s.translation_m = plain(camera->site_in_camera_m);
        return set_lens(s, camera->lens);
    }
    Eigen::Matrix3d from_corner = Eigen::Matrix3d::Identity();
    from_corner.col(2).head<2>().setConstant(half_a_pixel);
    const Eigen::Matrix3d rows = std::get_if<vision::FloorHomography>(&view)->floor_from_pixel * from_corner;
    const double size = rows.row(2).norm(); // any factor is as good; with this one the numbers can be read
    s.model = "homography";
    s.floor_x = plain(rows.row(0) / size);
    s.floor_y = plain(rows.row(1) / size);
    s.floor_w = plain(rows.row(2) / size);
    return true;
}

/// Of all that is set and not what it is by default.
std::string text_of(const CameraSettings& settings, const std::vector<std::string>& remarks) {
    const CameraSettings defaults;
    std::string text;
    for (const std::string& remark : remarks) text += "# " + remark + "\n";
    for (const OptionRow& row : camera_options) {
        const std::string value = to_yaml(row.get(&settings));
        if (value.empty() || (row.name != "model" && value == to_yaml(row.get(&defaults)))) continue;
        text += fmt::format("{}: {}\n", row.name, row.name == "model" ? settings.model : value);
    }
    return text;
}

} // namespace

std::string camera_yaml(const CameraCalibration& calibration, const std::vector<std::string>& remarks) {
    CameraSettings settings;
    set_size(settings, calibration.image_px);
    return set_view(settings, calibration.view) ? text_of(settings, remarks) : "";
}

std::string lens_yaml(const LensCalibration& calibration, const std::vector<std::string>& remarks) {
    CameraSettings settings;
    set_size(settings, calibration.image_px);
    return set_lens(settings, calibration.lens) ? text_of(settings, remarks) : "";
}

} // namespace locus::config
