#include "tools/calibrate/floor_points.h"

#include "fusion/vision/survey/floor_survey.h"
#include "tools/calibrate/points_file.h"
#include "tools/show/table.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace locus::calibrate {
namespace {

using vision::survey::FloorPair;
using vision::survey::FloorSurvey;
using vision::survey::FloorTrouble;

/// A floor that is known worse anywhere among its own points is no calibration.
constexpr double worst_floor_sigma_m = 1;

std::string sentence_of(FloorTrouble trouble, const FloorPoints& points) {
    switch (trouble) {
    case FloorTrouble::too_few:
        return fmt::format(
            "{} points are too few: at least 4 are needed, far apart and not in one line; 6 and more show "
            "which one is wrong",
            points.pairs.size());
    case FloorTrouble::in_one_line:
        return "the points lie in one line, and say nothing of the floor beside it: add some to the left and right";
    case FloorTrouble::mirrored:
        return "only a mirror shows the points like that: x and y were swapped, one of them was counted the wrong way, "
               "or "
               "pixels were counted from the image's lower edge";
    case FloorTrouble::not_told:
        return "these points do not tell how the camera sees the floor: three of four are in one line, or a pixel "
               "cannot "
               "be; add points far apart";
    case FloorTrouble::none:
        break;
    }
    return {};
}

/// The floor's standard deviation at a point, in the direction where it is worst.
double sure_to_m(const FloorSurvey& survey, const FloorPair& pair) {
    const Eigen::Matrix2d covariance_m2 = floor_covariance_m2(survey.fit, pair.site_m);
    if (!covariance_m2.allFinite()) return std::numeric_limits<double>::infinity();
    return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance_m2).eigenvalues()[1]);
}

void refuse(const FloorSurvey& survey, const FloorPoints& points) {
    if (survey.trouble != FloorTrouble::none) throw CannotTell(sentence_of(survey.trouble, points));
    for (std::size_t i = 0; i < points.pairs.size(); ++i)
        if (const double sigma_m = sure_to_m(survey, points.pairs[i]); !(sigma_m < worst_floor_sigma_m))
            throw CannotTell(fmt::format("the floor at {} would be known to {:.1f} m only{}", points.names[i], sigma_m,
                                         survey.widening > 3
                                             ? fmt::format(": the points do not fit each other, {} worst; check its "
                                                           "pixel and its place",
                                                           points.names[survey.worst])
                                             : ": add points around it"));
}

std::string verdict_of(const FloorSurvey& survey, const FloorPoints& points) {
    const std::string& name = points.names[survey.worst];
    const double left_m = survey.fit.residuals[survey.worst].floor_m;
    if (survey.is_worst_told)
        return fmt::format("{} does not fit the others: check its pixel and its place, or leave it out", name);
    if (survey.redundancy == 0)
        return "no number is left to check them with: add a point to see whether they are right";
    if (survey.widening > 2)
        return fmt::format(
            "the points do not fit each other ({:.1f} times worse than said), {} worst: check it; a point "
            "more may tell which one is wrong",
            survey.widening, name);
    return fmt::format("fits worst: {}, {:.3f} m", name, left_m);
}

std::string test_text(double test) { return std::isfinite(test) ? fmt::format("{:.1f}", std::sqrt(test)) : "-"; }

std::vector<std::string> lines_of(const FloorSurvey& survey, const FloorPoints& points) {
    std::vector<std::string> lines{
        fmt::format("{} points, {} numbers more than needed", points.pairs.size(), survey.redundancy), ""};
    using tools::Align;
    tools::Table table({{"point"},
                        {"x m", Align::right},
                        {"y m", Align::right},
                        {"residual px", Align::right},
                        {"residual m", Align::right},
                        {"sigmas from the others", Align::right},
                        {"known to m", Align::right}});
    for (std::size_t i = 0; i < points.pairs.size(); ++i) {
        const auto& residual = survey.fit.residuals[i];
        table.add({points.names[i], fmt::format("{:.3f}", points.pairs[i].site_m.x()),
                   fmt::format("{:.3f}", points.pairs[i].site_m.y()), fmt::format("{:.2f}", residual.error_px.norm()),
                   fmt::format("{:.3f}", residual.floor_m), test_text(survey.against_rest[i]),
                   fmt::format("{:.3f}", sure_to_m(survey, points.pairs[i]))});
    }
    for (auto& line : table.lines()) lines.push_back(std::move(line));
    lines.insert(lines.end(), {"", verdict_of(survey, points)});
    if (const auto* camera = std::get_if<vision::Camera>(&survey.fit.view))
        lines.push_back("the camera hangs at " +
                        position_text(camera->position_site_m(), position_sigma_m(survey.fit)));
    return lines;
}

nlohmann::json json_of(const FloorSurvey& survey, const FloorPoints& points) {
    nlohmann::json json{{"class", "CAMERA_POINTS"},
                        {"worst", points.names[survey.worst]},
                        {"worst_is_wrong", survey.is_worst_told},
                        {"widening", survey.widening},
                        {"points", nlohmann::json::array()}};
    for (std::size_t i = 0; i < points.pairs.size(); ++i)
        json["points"].push_back({{"name", points.names[i]},
                                  {"residual_px", survey.fit.residuals[i].error_px.norm()},
                                  {"residual_m", survey.fit.residuals[i].floor_m},
                                  {"sigma_m", sure_to_m(survey, points.pairs[i])}});
    return json;
}

} // namespace

CameraReport calibrate_points(const PointsRequest& request) {
    const auto lens = lens_of_file(request.lens, request.size);
    if (!lens && request.size.empty())
        throw std::runtime_error("how large is the image? Say it with --size 1280x720, or give the lens with --camera");
    const Eigen::Vector2d image_px = lens ? lens->image_px : parse_image_size(request.size);
    const FloorPoints points = read_points(request.file, request.sigma_px, request.sigma_m);
    const FloorSurvey survey =
        survey_floor(points.pairs, lens ? std::optional<vision::Lens>(lens->lens) : std::nullopt);
    refuse(survey, points);
    auto lines = lines_of(survey, points);
    const std::string yaml = checked_yaml(
        {survey.fit.view, image_px},
        {fmt::format("locus calibrate camera points: {} points", points.pairs.size()), verdict_of(survey, points)});
    return {std::move(lines), json_of(survey, points), yaml};
}

} // namespace locus::calibrate
