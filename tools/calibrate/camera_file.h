// What the three ways to calibrate a camera have in common: the file that comes out, and the refusals.
#pragma once

#include "config/camera_calibration.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace locus::calibrate {

/// The files are good, but what is in them does not tell the calibration: a sentence that says what to do.
class CannotTell : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A calibration that was found: for people, for programs and for the file.
struct CameraReport {
    std::vector<std::string> lines;
    nlohmann::json json;
    std::string yaml;
};

/// `value` is WIDTHxHEIGHT. Throws std::runtime_error.
Eigen::Vector2d parse_image_size(const std::string& value);

/// Of a file; nothing where the path is empty. For images of `size_px` where that is given. Throws std::runtime_error.
std::optional<config::LensCalibration> lens_of_file(const std::string& path, const std::string& size);

/// The view as YAML; it is read again, and std::runtime_error is thrown where that gives another view than this.
std::string checked_yaml(const config::CameraCalibration& calibration, const std::vector<std::string>& remarks);

/// "x, y, z" and their standard deviations.
std::string position_text(const Eigen::Vector3d& position_m, const Eigen::Vector3d& sigma_m);

/// Throws std::runtime_error where it cannot be written whole.
void write_file(const std::string& path, const std::string& text);

} // namespace locus::calibrate
