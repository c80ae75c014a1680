#include "tools/evaluate/report.h"

#include "tools/show/table.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <numbers>

namespace locus::evaluate {

namespace {

constexpr std::array<const char*, 3> axis_names{"x", "y", "z"};
constexpr std::array<const char*, 4> alignment_names{"none", "yaw", "se3", "sim3"};

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

std::string compared(const Association& association) {
    const auto& pairs = association.pairs;
    const std::size_t all = pairs.size() + association.outside_truth + association.in_gap + association.not_selected;
    return fmt::format("compared {} of {} poses, from {:.3f} s to {:.3f} s\n"
                       "left out {} outside the truth's time, {} in gaps of the truth, {} not selected",
                       pairs.size(), all, pairs.front().time_s, pairs.back().time_s, association.outside_truth,
                       association.in_gap, association.not_selected);
}

std::string aligned(const Evaluation& evaluation) {
    const auto& [scale, rotation, shift] = evaluation.similarity;
    if (evaluation.alignment == Alignment::none) return "not aligned";
    const std::string scaled = evaluation.alignment == Alignment::sim3 ? fmt::format(", scaled by {:.6f}", scale) : "";
    return fmt::format("aligned by {}: turned by {:.3f} degrees, moved by ({:.3f}, {:.3f}, {:.3f}) m{}",
                       alignment_names[static_cast<std::size_t>(evaluation.alignment)],
                       degrees(Eigen::AngleAxisd(rotation).angle()), shift.x(), shift.y(), shift.z(), scaled);
}

std::vector<std::string> row(const std::string& name, const Figures& f, const std::string& bias = "") {
    const auto m = [](double value) { return fmt::format("{:.3f}", value); };
    return {name, m(f.rmse_m), m(f.mean_m), m(f.median_m), m(f.p80_m), m(f.p95_m), m(f.max_m), bias};
}

std::vector<std::string> table(const Statistics& statistics) {
    using tools::Align;
    tools::Table table({{"error, m"},
                        {"RMSE", Align::right},
                        {"mean", Align::right},
                        {"median", Align::right},
                        {"80 %", Align::right},
                        {"95 %", Align::right},
                        {"maximum", Align::right},
                        {"bias", Align::right}});
    table.add(row("3D", statistics.spatial));
    table.add(row("horizontal", statistics.horizontal));
    for (std::size_t axis = 0; axis < 3; ++axis)
        table.add(row(axis_names[axis], statistics.axes[axis], fmt::format("{:+.3f}", statistics.bias_m[axis])));
    table.add(row("less bias: horizontal", statistics.horizontal_less_bias));
    for (std::size_t axis = 0; axis < 3; ++axis)
        table.add(row(std::string("less bias: ") + axis_names[axis], statistics.axes_less_bias[axis]));
    return table.lines();
}

void add_coverage(std::vector<std::string>& lines, const char* name, const std::optional<Coverage>& coverage) {
    if (!coverage) return;
    lines.push_back(
        fmt::format("{} error within its published 95 % bound for {:.1f} % of {} poses, mean bound {:.3f} m", name,
                    100 * coverage->share, coverage->count, coverage->mean_bound_m));
}

nlohmann::json to_json(const Figures& f) {
    return {{"rmse_m", f.rmse_m}, {"mean_m", f.mean_m}, {"median_m", f.median_m},
            {"p80_m", f.p80_m},   {"p95_m", f.p95_m},   {"max_m", f.max_m}};
}

nlohmann::json to_json(const Coverage& c) {
    return {{"share", c.share}, {"mean_bound_m", c.mean_bound_m}, {"poses", c.count}};
}

nlohmann::json to_json(const Similarity& similarity) {
    const Eigen::Quaterniond q(similarity.rotation);
    const auto& t = similarity.translation_m;
    return {{"scale", similarity.scale},
            {"rotation_xyzw", {q.x(), q.y(), q.z(), q.w()}},
            {"translation_m", {t.x(), t.y(), t.z()}}};
}

} // namespace

std::vector<std::string> report_lines(const Evaluation& evaluation) {
    std::vector<std::string> lines{compared(evaluation.association), aligned(evaluation), ""};
    for (auto& line : table(evaluation.statistics)) lines.push_back(std::move(line));
    add_coverage(lines, "horizontal", evaluation.statistics.horizontal_coverage);
    add_coverage(lines, "vertical", evaluation.statistics.vertical_coverage);
    return lines;
}

nlohmann::json report_json(const Evaluation& evaluation) {
    const auto& [association, alignment, similarity, statistics] = evaluation;
    nlohmann::json result{{"class", "EVALUATION"},
                          {"compared", association.pairs.size()},
                          {"outside_truth", association.outside_truth},
                          {"in_gap", association.in_gap},
                          {"not_selected", association.not_selected},
                          {"from_s", association.pairs.front().time_s},
                          {"to_s", association.pairs.back().time_s},
                          {"alignment", alignment_names[static_cast<std::size_t>(alignment)]},
                          {"transformation", to_json(similarity)},
                          {"spatial", to_json(statistics.spatial)},
                          {"horizontal", to_json(statistics.horizontal)},
                          {"horizontal_less_bias", to_json(statistics.horizontal_less_bias)},
                          {"bias_m", statistics.bias_m}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        result[axis_names[axis]] = to_json(statistics.axes[axis]);
        result[std::string(axis_names[axis]) + "_less_bias"] = to_json(statistics.axes_less_bias[axis]);
    }
    if (const auto& held = statistics.horizontal_coverage) result["horizontal_coverage"] = to_json(*held);
    if (const auto& held = statistics.vertical_coverage) result["vertical_coverage"] = to_json(*held);
    return result;
}

} // namespace locus::evaluate
