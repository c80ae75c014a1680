#include "tools/calibrate/anchors.h"

#include "config/address.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace locus::calibrate {
namespace {

using namespace uwb::survey;

std::string names_of(const std::vector<std::size_t>& stations, const MeasuredPairs& measured) {
    std::string text;
    for (const std::size_t i : stations) text += (text.empty() ? "" : ", ") + measured.anchors[i].name;
    return text;
}

std::size_t station_of(const std::string& word, const MeasuredPairs& measured) {
    const auto number = config::parse_address(word);
    for (std::size_t i = 0; i < measured.anchors.size(); ++i)
        if (measured.anchors[i].name == word || measured.anchors[i].address == number) return i;
    throw std::runtime_error(fmt::format("--known {}: no such anchor was measured", word));
}

Eigen::Vector3d position_of(const Anchor& anchor) {
    return {anchor.position_site_m[0], anchor.position_site_m[1], anchor.position_site_m[2]};
}

Vec3 place_in(const Image& image, std::size_t station) {
    const auto at_m = image.adjustment.position_m.row(static_cast<Eigen::Index>(station));
    return {at_m(0), at_m(1), at_m(2)};
}

} // namespace

Task task_of(const AnchorsRequest& request, const MeasuredPairs& measured) {
    if (request.config.empty() && (request.heights || !request.known.empty()))
        throw std::runtime_error("--known and --heights take positions from the settings: name them with --config");
    Task task;
    task.pairs = measured.pairs;
    task.third_on_right = request.beside == Side::right;
    task.stations.resize(measured.anchors.size());
    for (std::size_t i = 0; i < measured.anchors.size(); ++i) {
        if (request.heights) task.stations[i].height_site_m = measured.anchors[i].position_site_m[2];
        if (request.height_m) task.stations[i].height_site_m = request.height_m;
    }
    for (const std::string& word : request.known) {
        const std::size_t station = station_of(word, measured);
        task.stations[station].known_site_m = position_of(measured.anchors[station]);
    }
    return task;
}

std::string sentence_of(const Survey& survey, const MeasuredPairs& measured, int dimensions) {
    const std::string who = names_of(survey.about, measured);
    const bool flat = dimensions == 2;
    switch (survey.trouble) {
    case Trouble::none:
        return "";
    case Trouble::too_few_stations:
        return fmt::format("{} anchors have no shape: measure at least {}", measured.anchors.size(), dimensions + 1) +
               (flat ? "" : ", or give the heights (--heights, --height), then three are enough");
    case Trouble::disconnected:
        return "no measured distance joins the groups of " + who + ": measure between them, or survey each by itself";
    case Trouble::known_too_few:
        return flat ? "one known anchor makes no frame: give two, or none"
                    : "a frame needs three known anchors that do not stand in one line: give more, or none, or the "
                      "heights "
                      "as well (--heights, --height), then two are enough";
    case Trouble::known_in_line:
        return flat ? "the known anchors stand in one place on the floor: give others"
                    : "the known anchors stand in one line: give one beside it, or the heights as well (--heights)";
    case Trouble::frame_in_line:
        return "all anchors stand in one line: nothing tells which way the site lies; measure an anchor beside it";
    case Trouble::too_few_pairs:
        return fmt::format("{} measured fewer than {} others: too few for a place; measure more of them", who,
                           std::min<std::size_t>(static_cast<std::size_t>(dimensions), measured.anchors.size() - 1));
    }
    return "";
}

std::array<Side, 2> answers_of(const Survey& survey) {
    const bool by_height = survey.mirror && survey.mirror->by_height;
    return by_height ? std::array{Side::above, Side::below} : std::array{Side::left, Side::right};
}

std::string question_of(const Survey& survey, const MeasuredPairs& measured) {
    if (!survey.mirror) return "";
    const Mirror& mirror = *survey.mirror;
    const std::string name = measured.anchors[mirror.station].name;
    const auto at = [&](std::size_t image) { return yaml_of(place_in(survey.images[image], mirror.station)); };
    if (mirror.by_height)
        return fmt::format("Distances cannot tell the site from its mirror image. Is {} above, at {}, or below, at {}?",
                           name, at(0), at(1));
    return fmt::format("Distances cannot tell the site from its mirror image. Seen from above and looking from {} to "
                       "{}: is {} on the left, at {}, or on the right, at {}?",
                       measured.anchors[mirror.from].name, measured.anchors[mirror.to].name, name, at(0), at(1));
}

std::optional<Image> chosen(const Survey& survey, const AnchorsRequest& request) {
    if (!survey.mirror) return survey.images[0];
    const auto& said = survey.mirror->by_height ? request.over_it : request.beside;
    if (!said) return {};
    return survey.images[*said == answers_of(survey)[0] ? 0 : 1];
}

std::vector<AnchorEdit> edits_of(const Image& image, const MeasuredPairs& measured) {
    std::vector<AnchorEdit> edits;
    for (std::size_t i = 0; i < measured.anchors.size(); ++i)
        edits.push_back({measured.anchors[i].address, place_in(image, i), {}});
    return edits;
}

std::vector<std::string> yaml_lines(const Image& image, const MeasuredPairs& measured) {
    std::vector<std::string> lines{"site:", "  anchors:"};
    for (std::size_t i = 0; i < measured.anchors.size(); ++i)
        lines.push_back(fmt::format("    - {{name: {}, address: {}, position_site_m: {}}}", measured.anchors[i].name,
                                    config::to_text(measured.anchors[i].address), yaml_of(place_in(image, i))));
    return lines;
}

} // namespace locus::calibrate
