// What a survey found, for people and as JSON.
#include "config/address.h"
#include "tools/calibrate/anchors.h"
#include "tools/show/table.h"

#include <fmt/format.h>

#include <cmath>

namespace locus::calibrate {
namespace {

using namespace uwb::survey;
using tools::Align;

constexpr double lost_weight = 0.2; ///< at 4.8 sigma
constexpr double far_off = 3.5;     ///< of its own standard deviations: 1 normal error in 2,000

bool stands_out(const PairFit& fit) { return fit.weight < lost_weight || std::abs(fit.normalised) > far_off; }

std::string pair_name(const MeasuredPairs& measured, std::size_t pair) {
    return measured.anchors[measured.pairs[pair].a].name + " - " + measured.anchors[measured.pairs[pair].b].name;
}

double residual_of(const Image& image, const MeasuredPairs& measured, std::size_t station) {
    double squares = 0;
    int count = 0;
    for (std::size_t i = 0; i < measured.pairs.size(); ++i)
        if (measured.pairs[i].a == station || measured.pairs[i].b == station) {
            squares += image.adjustment.pairs[i].residual_m * image.adjustment.pairs[i].residual_m;
            ++count;
        }
    return count ? std::sqrt(squares / count) : 0;
}

std::string sigma_text(double sigma_m) {
    if (sigma_m == 0) return "given";
    return std::isfinite(sigma_m) ? fmt::format("{:.3f}", sigma_m) : "unknown";
}

std::vector<std::string> anchor_table(const Image& image, const MeasuredPairs& measured) {
    tools::Table table({{"anchor"},
                        {"x m", Align::right},
                        {"y m", Align::right},
                        {"z m", Align::right},
                        {"sigma x", Align::right},
                        {"sigma y", Align::right},
                        {"sigma z", Align::right},
                        {"residual m", Align::right}});
    for (std::size_t i = 0; i < measured.anchors.size(); ++i) {
        std::vector<std::string> cells{measured.anchors[i].name};
        const auto row = static_cast<Eigen::Index>(i);
        for (int axis = 0; axis < 3; ++axis)
            cells.push_back(fmt::format("{:.3f}", image.adjustment.position_m(row, axis)));
        for (int axis = 0; axis < 3; ++axis) cells.push_back(sigma_text(image.adjustment.sigma_m(row, axis)));
        cells.push_back(fmt::format("{:.3f}", residual_of(image, measured, i)));
        table.add(std::move(cells));
    }
    return table.lines();
}

std::string outlier_line(const Image& image, const MeasuredPairs& measured, std::size_t pair) {
    const PairFit& fit = image.adjustment.pairs[pair];
    return fmt::format("  {}: {:.3f} m measured, {:.3f} m too {}: {}", pair_name(measured, pair),
                       measured.pairs[pair].range_m, std::abs(fit.residual_m), fit.residual_m > 0 ? "long" : "short",
                       fit.residual_m > 0 ? "something in the way, or the wrong anchor" : "the wrong anchor?");
}

std::string pairs_line(const Survey& survey, const Image& image, const MeasuredPairs& measured) {
    std::size_t ranges = 0;
    for (const std::size_t count : measured.counts) ranges += count;
    const int spare = image.adjustment.redundancy;
    std::string line =
        fmt::format("{} anchors, {} pairs of {} ranges; ", measured.anchors.size(), measured.pairs.size(), ranges);
    line += spare > 0 ? fmt::format("{} pairs more than needed", spare)
                      : "no pair more than needed: a wrong distance would not be seen";
    if (image.adjustment.scale > 1.05)
        line += fmt::format("; residuals are {:.1f} times what they should be, and so is every sigma",
                            image.adjustment.scale);
    if (survey.by_convention)
        line += fmt::format("\nframe by convention: {} is the origin, {} lies on +x, {} beside it",
                            measured.anchors[survey.frame[0]].name, measured.anchors[survey.frame[1]].name,
                            measured.anchors[survey.frame[2]].name);
    return line;
}

} // namespace

std::vector<std::string> not_told(const Image& image, const MeasuredPairs& measured) {
    std::vector<std::string> sentences;
    constexpr std::array axes{'x', 'y', 'z'};
    for (std::size_t i = 0; i < measured.anchors.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double sigma_m =
                image.adjustment.sigma_m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(axis));
            if (sigma_m <= worst_sigma_m) continue;
            const auto size = std::isfinite(sigma_m) ? fmt::format("its standard deviation is {:.1f} m", sigma_m)
                                                     : "it could be anything";
            sentences.push_back(fmt::format("{} of {} does not follow from these distances: {}", axes.at(axis),
                                            measured.anchors[i].name, size));
        }
    if (!sentences.empty())
        sentences.emplace_back(
            "anchors that hang equally high tell no heights: measure those with a tape and give them "
            "(--heights, --height); else measure these anchors to more others, or name known ones "
            "(--known) that do not stand in one plane with them");
    return sentences;
}

std::vector<std::string> report_lines(const Survey& survey, const Image& image, const MeasuredPairs& measured) {
    std::vector<std::string> lines{pairs_line(survey, image, measured), ""};
    for (auto& line : anchor_table(image, measured)) lines.push_back(std::move(line));
    std::vector<std::string> outliers;
    for (std::size_t i = 0; i < measured.pairs.size(); ++i)
        if (stands_out(image.adjustment.pairs[i])) outliers.push_back(outlier_line(image, measured, i));
    if (!outliers.empty()) lines.insert(lines.end(), {"", "pairs that do not fit, and count little or nothing:"});
    lines.insert(lines.end(), outliers.begin(), outliers.end());
    for (const Doubt& doubt : image.doubts)
        lines.push_back(fmt::format("{} would fit as well at {}: measure it to one more anchor",
                                    measured.anchors[doubt.station].name,
                                    yaml_of(Vec3{doubt.also_at_m.x(), doubt.also_at_m.y(), doubt.also_at_m.z()})));
    for (const std::string& note : measured.notes) lines.push_back(note);
    return lines;
}

nlohmann::json report_json(const Image& image, const MeasuredPairs& measured) {
    nlohmann::json report{{"class", "ANCHOR_SURVEY"},
                          {"redundancy", image.adjustment.redundancy},
                          {"notes", measured.notes},
                          {"anchors", nlohmann::json::array()},
                          {"pairs", nlohmann::json::array()}};
    for (std::size_t i = 0; i < measured.anchors.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        const auto& at_m = image.adjustment.position_m;
        const auto& sigma_m = image.adjustment.sigma_m;
        report["anchors"].push_back({{"name", measured.anchors[i].name},
                                     {"address", number(measured.anchors[i].address)},
                                     {"position_site_m", {at_m(row, 0), at_m(row, 1), at_m(row, 2)}},
                                     {"sigma_m", {sigma_m(row, 0), sigma_m(row, 1), sigma_m(row, 2)}}});
    }
    for (std::size_t i = 0; i < measured.pairs.size(); ++i) {
        const PairFit& fit = image.adjustment.pairs[i];
        report["pairs"].push_back({{"a", measured.anchors[measured.pairs[i].a].name},
                                   {"b", measured.anchors[measured.pairs[i].b].name},
                                   {"range_m", measured.pairs[i].range_m},
                                   {"residual_m", fit.residual_m},
                                   {"weight", fit.weight},
                                   {"fits", !stands_out(fit)}});
    }
    return report;
}

} // namespace locus::calibrate
