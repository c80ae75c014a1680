#include "config/camera_calibration.h"

#include "config/camera_settings.h"
#include "config/file_text.h"
#include "config/map_reader.h"
#include "fusion/geometry/vector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace locus::config {
namespace {

using vision::Camera;
using vision::FloorView;

bool is_set(double value) { return std::isfinite(value); }
bool is_set(const Vec3& value) {
    return std::all_of(value.begin(), value.end(), [](double v) { return is_set(v); });
}

/// Adds a problem and gives false when a key that the model needs was left out.
template <class Value>
bool has(const Value& value, std::string_view key, const CameraSettings& settings, Problems& problems) {
    if (!is_set(value)) problems.add({}, fmt::format("missing: {}, which the model \"{}\" needs", key, settings.model));
    return is_set(value);
}

/// Of answers that were all asked for, so that all that is missing is told in one go.
bool all(std::initializer_list<bool> answers) {
    return std::find(answers.begin(), answers.end(), false) == answers.end();
}

/// OpenCV counts pixels from the middle of the first one.
constexpr double half_pixel = 0.5;

vision::Lens lens_of(const CameraSettings& s) {
    const Eigen::Vector2d focal_px(s.fx_px, s.fy_px), centre_px(s.cx_px + half_pixel, s.cy_px + half_pixel);
    if (s.model == "fisheye") return vision::FisheyeLens{focal_px, centre_px, {s.k1, s.k2, s.k3, s.k4}};
    return vision::PinholeLens{focal_px, centre_px, {s.k1, s.k2, s.k3, s.k4, s.k5, s.k6}, {s.p1, s.p2}};
}

bool has_lens(const CameraSettings& s, Problems& problems) {
    return all({has(s.fx_px, "fx_px", s, problems), has(s.fy_px, "fy_px", s, problems),
                has(s.cx_px, "cx_px", s, problems), has(s.cy_px, "cy_px", s, problems)});
}

std::optional<FloorView> camera_of(const CameraSettings& s, Problems& problems) {
    const bool is_whole = all({has_lens(s, problems), has(s.rotation_vector_rad, "rotation_vector_rad", s, problems),
                               has(s.translation_m, "translation_m", s, problems)});
    if (!is_whole) return std::nullopt;
    const Eigen::Vector3d turn = vector(s.rotation_vector_rad);
    Camera camera{lens_of(s), Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()).toRotationMatrix(),
                  vector(s.translation_m)};
    if (camera.position_site_m().z() > 0) return camera;
    problems.add({},
                 fmt::format("the camera would stand {:.2f} m below the floor: rotation_vector_rad and translation_m "
                             "must be those from the site (z up) to the camera",
                             -camera.position_site_m().z()));
    return std::nullopt;
}

std::optional<FloorView> homography_of(const CameraSettings& s, Problems& problems) {
    const bool is_whole = all({has(s.floor_x, "floor_x", s, problems), has(s.floor_y, "floor_y", s, problems),
                               has(s.floor_w, "floor_w", s, problems)});
    if (!is_whole) return std::nullopt;
    Eigen::Matrix3d rows, from_middle = Eigen::Matrix3d::Identity();
    rows << vector(s.floor_x).transpose(), vector(s.floor_y).transpose(), vector(s.floor_w).transpose();
    from_middle.col(2).head<2>().setConstant(-half_pixel);
    if (!rows.fullPivLu().isInvertible()) {
        problems.add({}, "floor_x, floor_y, floor_w: these three rows make no homography, they depend on each other");
        return std::nullopt;
    }
    const Eigen::Vector2d bottom_middle(0.5 * s.width_px, s.height_px);
    return vision::floor_homography(rows * from_middle, bottom_middle);
}

std::optional<CameraSettings> settings_of(std::string_view text, Problems& problems) {
    const auto tree = parse_yaml(text, problems);
    CameraSettings settings;
    const BoundOptions table[]{{camera_options, &settings}};
    if (!tree || !read_map(*tree, {"camera"}, table, problems) || !problems.empty()) return std::nullopt;
    return settings;
}

bool is_xml(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    return first != std::string_view::npos && text[first] == '<';
}

/// What `parse` makes of a file's text.
template <class Calibration>
std::optional<Calibration> load(const std::string& path, std::vector<ConfigProblem>& problems,
                                std::optional<Calibration> (*parse)(std::string_view, Problems&)) {
    Problems found(path);
    std::string error;
    std::optional<Calibration> calibration;
    if (const auto text = read_file(path, error))
        calibration = parse(*text, found);
    else
        found.add({}, error);
    for (auto& problem : found.take()) problems.push_back(std::move(problem));
    return calibration;
}

} // namespace

std::optional<CameraCalibration> parse_camera_yaml(std::string_view text, Problems& problems) {
    const auto settings = settings_of(text, problems);
    if (!settings) return std::nullopt;
    auto view = settings->model == "homography" ? homography_of(*settings, problems) : camera_of(*settings, problems);
    if (!view) return std::nullopt;
    return CameraCalibration{*view, {settings->width_px, settings->height_px}};
}

std::optional<LensCalibration> parse_lens(std::string_view text, Problems& problems) {
    if (is_xml(text)) {
        problems.add({}, "this is XML: a lens is read from YAML of the model pinhole or fisheye, as `locus calibrate "
                         "camera chessboard` writes it");
        return std::nullopt;
    }
    const auto settings = settings_of(text, problems);
    if (!settings) return std::nullopt;
    if (settings->model == "homography")
        problems.add({}, "a homography says nothing of the lens: give a calibration of the model pinhole or fisheye");
    else if (has_lens(*settings, problems))
        return LensCalibration{lens_of(*settings), {settings->width_px, settings->height_px}};
    return std::nullopt;
}

std::optional<CameraCalibration> parse_camera(std::string_view text, Problems& problems) {
    return is_xml(text) ? parse_tsai_xml(text, problems) : parse_camera_yaml(text, problems);
}

std::optional<CameraCalibration> load_camera(const std::string& path, std::vector<ConfigProblem>& problems) {
    return load(path, problems, parse_camera);
}

std::optional<LensCalibration> load_lens(const std::string& path, std::vector<ConfigProblem>& problems) {
    return load(path, problems, parse_lens);
}

vision::FloorView view_for(const CameraCalibration& calibration, const Eigen::Vector2d& image_px) noexcept {
    return vision::scaled(calibration.view, image_px.cwiseQuotient(calibration.image_px));
}

} // namespace locus::config
