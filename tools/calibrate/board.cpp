#include "tools/calibrate/board.h"

#include "config/camera_text.h"
#include "drivers/camera/picture_file.h"
#include "tools/show/table.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace locus::calibrate {
namespace {

/// Zhang 2000 needs three; two more show whether they agree.
constexpr std::size_t least_boards = 5;
/// Zhang 2000, section 5.1: below some 10 degrees calibrations fail or err several times as much as at 45.
constexpr double least_tilt_deg = 15;
/// Focal lengths that are known worse are no calibration: 5 % are 5 cm at one metre beside the axis.
constexpr double worst_focal_share = 0.05;
/// Of the image's width or height, below which what lies outside is extrapolated.
constexpr double covered_share = 0.6;

struct Boards {
    std::vector<std::string> names, without; ///< images with a board, and without
    std::vector<camera::BoardCorners> corners;
    Eigen::Vector2d image_px{0, 0};
};

std::vector<std::string> files_of(const std::vector<std::string>& images) {
    if (images.size() != 1 || !std::filesystem::is_directory(images[0])) return images;
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(images[0]))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

Boards read_boards(const BoardRequest& request) {
    Boards boards;
    for (const std::string& file : files_of(request.images)) {
        std::string error;
        const auto picture = camera::read_picture(file, error);
        if (!picture) throw std::runtime_error(error);
        const Eigen::Vector2d size_px(picture->width_px, picture->height_px);
        if (boards.image_px.isZero()) boards.image_px = size_px;
        if (size_px != boards.image_px)
            throw std::runtime_error(fmt::format(
                "'{}' is {} x {} px and the images before it {} x {}: take all with the camera as it will run", file,
                size_px.x(), size_px.y(), boards.image_px.x(), boards.image_px.y()));
        const auto corners = camera::find_chessboard(*picture, request.shape);
        (corners ? boards.names : boards.without).push_back(file);
        if (corners) boards.corners.push_back(*corners);
    }
    return boards;
}

/// The largest angle between two boards.
double tilt_deg(const camera::LensFit& fit) {
    double least = 1;
    for (const auto& one : fit.boards)
        for (const auto& other : fit.boards)
            least = std::min(least, std::abs(one.normal_in_camera.dot(other.normal_in_camera)));
    return std::acos(least) * 180 / std::numbers::pi;
}

void refuse_few(const Boards& boards, const camera::BoardShape& shape) {
    if (boards.names.size() >= least_boards) return;
    throw CannotTell(fmt::format(
        "a board of {} x {} inner corners was found in {} of {} images, and {} are needed: count the corners inside of "
        "the board, not its squares, and show all of it, sharp and with its white border; ten to twenty images are "
        "good",
        shape.columns, shape.rows, boards.names.size(), boards.names.size() + boards.without.size(), least_boards));
}

constexpr const char* how_to_tilt =
    "hold the board large in the image, at 20 to 45 degrees, to the left, to the right, "
    "up and down";

void refuse_vague(const camera::LensFit& fit) {
    for (std::size_t i = 0; i < 2; ++i)
        if (const auto& focal = fit.parameters[i]; !(focal.sigma < worst_focal_share * focal.value))
            throw CannotTell(
                fmt::format("{} is known to +- {:.0f} px only, of {:.0f}: the boards never tilt enough, and "
                            "then a near board cannot be told from a long lens; {}",
                            focal.name, focal.sigma, focal.value, how_to_tilt));
    if (tilt_deg(fit) < least_tilt_deg)
        throw CannotTell(fmt::format("the boards never tilt enough (at most {:.0f} degrees from each other): {}",
                                     tilt_deg(fit), how_to_tilt));
}

std::vector<std::string> remarks_of(const Boards& boards, const camera::LensFit& fit) {
    std::vector<std::string> remarks{fmt::format(
        "locus calibrate camera chessboard: {} boards, reprojection error {:.3f} px", boards.names.size(), fit.rms_px)};
    for (const auto& one : fit.parameters) remarks.push_back(fmt::format("{} +- {:.2g}", one.name, one.sigma));
    return remarks;
}

/// Share of the image's width and height that the corners reach over.
Eigen::Vector2d reach_of(const Boards& boards) {
    Eigen::AlignedBox2d reach;
    for (const auto& corners : boards.corners)
        for (const auto& corner : corners) reach.extend(corner);
    return reach.sizes().cwiseQuotient(boards.image_px);
}

std::vector<std::string> lines_of(const Boards& boards, const camera::LensFit& fit) {
    std::vector<std::string> lines{
        fmt::format("{} boards in {} images, up to {:.0f} degrees from each other; reprojection error "
                    "{:.3f} px",
                    boards.names.size(), boards.names.size() + boards.without.size(), tilt_deg(fit), fit.rms_px),
        ""};
    tools::Table table({{"parameter"}, {"value", tools::Align::right}, {"sigma", tools::Align::right}});
    for (const auto& one : fit.parameters)
        table.add({one.name, fmt::format("{:.5g}", one.value), fmt::format("{:.2g}", one.sigma)});
    for (auto& line : table.lines()) lines.push_back(std::move(line));
    lines.emplace_back();
    const auto worst = std::ranges::max_element(fit.boards, {}, &camera::BoardFit::rms_px);
    lines.push_back(fmt::format("fits worst: {}, {:.3f} px",
                                boards.names[static_cast<std::size_t>(worst - fit.boards.begin())], worst->rms_px));
    for (const auto& file : boards.without) lines.push_back("no board found: " + file);
    if (const auto reach = reach_of(boards); reach.minCoeff() < covered_share)
        lines.push_back(
            fmt::format("the boards reach over {:.0f} % of the width and {:.0f} % of the height: what the lens "
                        "does outside of them is a guess; show the board in the corners too",
                        100 * reach.x(), 100 * reach.y()));
    return lines;
}

nlohmann::json json_of(const Boards& boards, const camera::LensFit& fit) {
    nlohmann::json json{{"class", "CAMERA_LENS"},          {"boards", boards.names.size()},
                        {"without_board", boards.without}, {"reprojection_error_px", fit.rms_px},
                        {"tilt_deg", tilt_deg(fit)},       {"parameters", nlohmann::json::object()}};
    for (const auto& one : fit.parameters) json["parameters"][one.name] = {{"value", one.value}, {"sigma", one.sigma}};
    return json;
}

} // namespace

CameraReport calibrate_lens(const BoardRequest& request) {
    const Boards boards = read_boards(request);
    refuse_few(boards, request.shape);
    std::string error;
    const auto fit = camera::fit_lens(boards.corners, request.shape, boards.image_px, request.is_fisheye, error);
    if (!fit) throw CannotTell(error + ": leave out blurred images, and tilt the board in all directions");
    refuse_vague(*fit);
    return {lines_of(boards, *fit), json_of(boards, *fit),
            config::lens_yaml({fit->lens, boards.image_px}, remarks_of(boards, *fit))};
}

} // namespace locus::calibrate
