// Tsai calibrations in XML, as the recordings of PETS have them, by pugixml.
#include "config/camera_calibration.h"
#include "config/yaml_tree.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace locus::config {
namespace {

/// Where a byte of the text stands.
Mark mark_of(std::string_view text, std::ptrdiff_t offset) {
    const auto until =
        text.substr(0, std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)), text.size()));
    const auto line_start = until.rfind('\n');
    const auto column = line_start == std::string_view::npos ? until.size() : until.size() - line_start - 1;
    return {static_cast<int>(std::count(until.begin(), until.end(), '\n')) + 1, static_cast<int>(column) + 1};
}

/// The numbers of one element; each that is not there, or is no number within its limits, is a problem.
class Numbers {
  public:
    Numbers(std::string_view text, const pugi::xml_node& camera, const char* element, Problems& problems)
        : text_(text), node_(camera.child(element)), element_(element), problems_(problems) {
        if (!node_) problems.add(mark_of(text, camera.offset_debug()), fmt::format("missing: <{}>", element));
    }

    /// 0 where there was a problem.
    double get(const char* name, double minimum, double maximum) {
        const std::string_view value = node_.attribute(name).as_string();
        double number = 0;
        const auto [end, error] = std::from_chars(value.begin(), value.end(), number);
        if (value.empty())
            complain(fmt::format("missing: {} of <{}>", name, element_));
        else if (error != std::errc{} || end != value.end() || !std::isfinite(number))
            complain(fmt::format("wrong type: {} of <{}> is \"{}\", it must be a number", name, element_,
                                 value.substr(0, 40)));
        else if (number < minimum || number > maximum)
            complain(fmt::format("out of range: {} of <{}> is {}, it must be between {} and {}", name, element_, number,
                                 minimum, maximum));
        else
            return number;
        return 0;
    }

  private:
    std::string_view text_;
    pugi::xml_node node_;
    const char* element_;
    Problems& problems_;

    void complain(std::string message) {
        if (node_) problems_.add(mark_of(text_, node_.offset_debug()), std::move(message));
    }
};

constexpr double longest_mm = 1e8; // 100 km
constexpr double full_turn_rad = 6.2832;
constexpr double half_pixel_px = 0.5; // Tsai counts pixels from the middle of the first one

vision::TsaiLens read_lens(Numbers& geometry, Numbers& intrinsic) {
    vision::TsaiLens lens;
    const double stretch = intrinsic.get("sx", 0.1, 10);
    lens.pitch_mm = {geometry.get("dpx", 1e-6, 1) / stretch, geometry.get("dpy", 1e-6, 1)};
    lens.focal_mm = intrinsic.get("focal", 1e-3, 1e4);
    lens.kappa1_per_mm2 = intrinsic.get("kappa1", -1e3, 1e3);
    lens.centre_px = {intrinsic.get("cx", -1e6, 1e6), intrinsic.get("cy", -1e6, 1e6)};
    lens.centre_px.array() += half_pixel_px;
    return lens;
}

vision::Camera read_extrinsic(Numbers& extrinsic, const vision::Lens& lens) {
    const auto turn = [&](const char* name, const Eigen::Vector3d& axis) {
        return Eigen::AngleAxisd(extrinsic.get(name, -full_turn_rad, full_turn_rad), axis);
    };
    const auto move_m = [&](const char* name) { return 1e-3 * extrinsic.get(name, -longest_mm, longest_mm); };
    const auto about_x = turn("rx", Eigen::Vector3d::UnitX());
    const auto about_y = turn("ry", Eigen::Vector3d::UnitY());
    const auto about_z = turn("rz", Eigen::Vector3d::UnitZ());
    const double x_m = move_m("tx"), y_m = move_m("ty"), z_m = move_m("tz");
    return {lens, (about_z * about_y * about_x).toRotationMatrix(), {x_m, y_m, z_m}};
}

} // namespace

std::optional<CameraCalibration> parse_tsai_xml(std::string_view text, Problems& problems) {
    if (text.size() > max_file_bytes) {
        problems.add({}, fmt::format("this file is larger than {} bytes, no calibration is", max_file_bytes));
        return std::nullopt;
    }
    pugi::xml_document document;
    if (const auto parsed = document.load_buffer(text.data(), text.size()); !parsed) {
        problems.add(mark_of(text, parsed.offset), fmt::format("this is no XML: {}", parsed.description()));
        return std::nullopt;
    }
    const pugi::xml_node camera = document.child("Camera");
    if (!camera) {
        problems.add({}, "missing: <Camera>, with <Geometry>, <Intrinsic> and <Extrinsic> in it");
        return std::nullopt;
    }
    Numbers geometry(text, camera, "Geometry", problems), intrinsic(text, camera, "Intrinsic", problems),
        extrinsic(text, camera, "Extrinsic", problems);
    const Eigen::Vector2d image_px(geometry.get("width", 1, 65536), geometry.get("height", 1, 65536));
    const vision::Camera view = read_extrinsic(extrinsic, read_lens(geometry, intrinsic));
    if (problems.empty() && !(view.position_site_m().z() > 0))
        problems.add({}, fmt::format("the camera would stand {:.2f} m below the floor", -view.position_site_m().z()));
    return problems.empty() ? std::optional(CameraCalibration{view, image_px}) : std::nullopt;
}

} // namespace locus::config
