#include "tools/calibrate/points_file.h"

#include "tools/calibrate/fields.h"
#include "tools/import/lines.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace locus::calibrate {
namespace {

constexpr std::size_t most_points = 1000;
constexpr double largest = 1e6; // px and m
/// Two pixels and two metres.
std::optional<std::array<double, 4>> numbers_of(const std::vector<std::string_view>& fields) {
    std::array<double, 4> values{};
    if (fields.size() != 4 && fields.size() != 5) return std::nullopt;
    for (std::size_t i = 0; i < 4; ++i) {
        const double value = number_of(fields[i]).value_or(largest);
        if (!(std::abs(value) < largest)) return std::nullopt;
        values[i] = value;
    }
    return values;
}

bool says_something(std::string_view line, bool is_first) {
    return line.find_first_not_of(" \t") != std::string_view::npos && !(is_first && line.starts_with("x_px"));
}

} // namespace

FloorPoints read_points(const std::string& path, double sigma_px, double sigma_m) {
    importing::Lines lines(path);
    FloorPoints points;
    for (std::string_view line; lines.next(line);) {
        line = line.substr(0, line.find('#'));
        if (!says_something(line, points.pairs.empty())) continue;
        const auto fields = fields_of(line);
        const auto numbers = numbers_of(fields);
        if (!numbers)
            throw std::runtime_error(
                fmt::format("{}:{}: it is not x_px,y_px,x_m,y_m or x_px,y_px,x_m,y_m,name", path, lines.number()));
        const auto [u_px, v_px, x_m, y_m] = *numbers;
        points.pairs.push_back({{u_px + 0.5, v_px + 0.5}, {x_m, y_m}, sigma_px, sigma_m});
        points.names.push_back(fields.size() == 5 ? std::string(fields[4]) : fmt::format("line {}", lines.number()));
        if (points.pairs.size() > most_points)
            throw std::runtime_error(
                fmt::format("'{}' holds more than {} points: is it the right file?", path, most_points));
    }
    return points;
}

} // namespace locus::calibrate
