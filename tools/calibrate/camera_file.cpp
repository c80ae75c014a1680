#include "tools/calibrate/camera_file.h"

#include "config/camera_text.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <fstream>

namespace locus::calibrate {
namespace {

constexpr int largest_px = 65536; // as in config/camera_settings.h

[[noreturn]] void no_size(const std::string& value) {
    throw std::runtime_error("--size " + value + " is no size of an image: say it as 1280x720");
}

std::optional<Eigen::Vector2d> floor_at(const vision::FloorView& view, const Eigen::Vector2d& pixel_px) {
    const auto point = vision::foot_on_floor(view, {pixel_px, Eigen::Matrix2d::Identity()});
    return point ? std::optional<Eigen::Vector2d>(point->position_site_m) : std::nullopt;
}

bool is_near(const std::optional<Eigen::Vector2d>& one_m, const std::optional<Eigen::Vector2d>& other_m) {
    if (!one_m.has_value() || !other_m.has_value()) return one_m.has_value() == other_m.has_value();
    return (*one_m - *other_m).norm() < 1e-6 * (1 + one_m->norm());
}

/// At nine places of the image.
bool is_same(const vision::FloorView& one, const vision::FloorView& other, const Eigen::Vector2d& image_px) {
    for (const double across : {0.15, 0.5, 0.85})
        for (const double down : {0.3, 0.6, 0.95}) {
            const Eigen::Vector2d pixel_px = image_px.cwiseProduct(Eigen::Vector2d(across, down));
            if (!is_near(floor_at(one, pixel_px), floor_at(other, pixel_px))) return false;
        }
    return true;
}

} // namespace

Eigen::Vector2d parse_image_size(const std::string& value) {
    std::array<int, 2> size{};
    const auto cross = value.find('x');
    if (cross == std::string::npos) no_size(value);
    const std::array words{std::string_view(value).substr(0, cross), std::string_view(value).substr(cross + 1)};
    for (std::size_t i = 0; i < 2; ++i) {
        const auto [end, error] = std::from_chars(words[i].begin(), words[i].end(), size[i]);
        if (error != std::errc{} || end != words[i].end() || size[i] < 1 || size[i] > largest_px) no_size(value);
    }
    return {size[0], size[1]};
}

std::optional<config::LensCalibration> lens_of_file(const std::string& path, const std::string& size) {
    if (path.empty()) return {};
    std::vector<ConfigProblem> problems;
    auto lens = config::load_lens(path, problems);
    if (!lens) throw std::runtime_error(problems.empty() ? path + " holds no lens" : to_string(problems.front()));
    if (size.empty()) return lens;
    const Eigen::Vector2d image_px = parse_image_size(size);
    return config::LensCalibration{vision::scaled(lens->lens, image_px.cwiseQuotient(lens->image_px)), image_px};
}

std::string checked_yaml(const config::CameraCalibration& calibration, const std::vector<std::string>& remarks) {
    std::string yaml = config::camera_yaml(calibration, remarks);
    config::Problems problems("the calibration that was found");
    const auto read = config::parse_camera(yaml, problems);
    if (!read) throw std::runtime_error(to_string(problems.take().front()));
    if (!is_same(read->view, calibration.view, calibration.image_px))
        throw std::runtime_error(
            "the calibration cannot be written: the middle of the image's lower edge must show the "
            "floor; turn the camera so that it does");
    return yaml;
}

std::string position_text(const Eigen::Vector3d& position_m, const Eigen::Vector3d& sigma_m) {
    return fmt::format("({:.2f}, {:.2f}, {:.2f}) m, +- ({:.2f}, {:.2f}, {:.2f}) m", position_m.x(), position_m.y(),
                       position_m.z(), sigma_m.x(), sigma_m.y(), sigma_m.z());
}

void write_file(const std::string& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw std::runtime_error("'" + path + "' cannot be written: is there such a folder, and may you write?");
}

} // namespace locus::calibrate
