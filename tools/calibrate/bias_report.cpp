// What a walk told of the anchors' biases, for people and as JSON.
#include "config/address.h"
#include "tools/calibrate/bias.h"
#include "tools/show/table.h"

#include <fmt/format.h>

namespace locus::calibrate {
namespace {

using tools::Align;

/// A bias that is known little better than how far anchors are apart before the walk is not told.
constexpr double told_share_of_prior = 0.5;

bool told(const BiasReport& report, const BiasRequest& request, std::size_t anchor) {
    return report.biases.counts[anchor] > 0 &&
           report.biases.sigma_m(static_cast<Eigen::Index>(anchor)) < told_share_of_prior * request.walk.own_prior_m;
}

std::vector<std::string> anchor_lines(const BiasReport& report, const BiasRequest& request) {
    tools::Table table({{"anchor"},
                        {"ranges", Align::right},
                        {"spread m", Align::right},
                        {"bias m", Align::right},
                        {"sigma m", Align::right},
                        {"of its own", Align::right},
                        {""}});
    for (std::size_t i = 0; i < report.walk.anchors.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        table.add({report.walk.anchors[i].name, fmt::format("{}", report.biases.counts[i]),
                   fmt::format("{:.3f}", report.biases.spread_m(row)),
                   fmt::format("{:+.3f}", report.biases.bias_m(row)), fmt::format("{:.3f}", report.biases.sigma_m(row)),
                   fmt::format("{:.3f}", report.biases.own_sigma_m(row)),
                   told(report, request, i) ? "" : "not told by this walk"});
    }
    return table.lines();
}

} // namespace

std::vector<std::string> report_lines(const BiasReport& report, const BiasRequest& request) {
    std::vector<std::string> lines{
        fmt::format("{} ranges over {:.0f} s, {}", report.walk.ranges.size(),
                    report.walk.ranges.back().time_s - report.walk.ranges.front().time_s,
                    report.with_truth ? "against the track that was given" : "the path estimated with the biases"),
        ""};
    for (auto& line : anchor_lines(report, request)) lines.push_back(std::move(line));
    if (!report.with_truth)
        lines.insert(lines.end(), {"",
                                   fmt::format("what all anchors have in common is known to {:.3f} m: a path that is "
                                               "longer or shorter everywhere",
                                               report.biases.common_sigma_m()),
                                   "explains the same ranges nearly as well; `of its own` is each anchor against the "
                                   "others."});
    for (const std::string& note : report.walk.notes) lines.push_back(note);
    return lines;
}

nlohmann::json report_json(const BiasReport& report) {
    nlohmann::json json{{"class", "BIAS_CALIBRATION"},
                        {"ranges", report.walk.ranges.size()},
                        {"common_sigma_m", report.biases.common_sigma_m()},
                        {"notes", report.walk.notes},
                        {"anchors", nlohmann::json::array()}};
    for (std::size_t i = 0; i < report.walk.anchors.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        json["anchors"].push_back({{"name", report.walk.anchors[i].name},
                                   {"address", number(report.walk.anchors[i].address)},
                                   {"ranges", report.biases.counts[i]},
                                   {"range_bias_m", report.biases.bias_m(row)},
                                   {"sigma_m", report.biases.sigma_m(row)},
                                   {"own_sigma_m", report.biases.own_sigma_m(row)},
                                   {"spread_m", report.biases.spread_m(row)}});
    }
    return json;
}

std::vector<AnchorEdit> edits_of(const BiasReport& report, const BiasRequest& request) {
    std::vector<AnchorEdit> edits;
    for (std::size_t i = 0; i < report.walk.anchors.size(); ++i)
        if (told(report, request, i))
            edits.push_back({report.walk.anchors[i].address, {}, report.biases.bias_m(static_cast<Eigen::Index>(i))});
    return edits;
}

std::vector<std::string> yaml_lines(const BiasReport& report, const BiasRequest& request) {
    std::vector<std::string> lines{"site:", "  anchors:"};
    for (std::size_t i = 0; i < report.walk.anchors.size(); ++i)
        if (const Anchor& anchor = report.walk.anchors[i]; told(report, request, i))
            lines.push_back(fmt::format("    - {{name: {}, address: {}, position_site_m: {}, range_bias_m: {}}}",
                                        anchor.name, config::to_text(anchor.address), yaml_of(anchor.position_site_m),
                                        yaml_of(report.biases.bias_m(static_cast<Eigen::Index>(i)))));
    return lines;
}

} // namespace locus::calibrate
