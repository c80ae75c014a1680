// locus evaluate: how far an estimate was from the truth.
#include "tools/client/command.h"
#include "tools/evaluate/plot.h"
#include "tools/evaluate/read.h"
#include "tools/evaluate/report.h"
#include "tools/show/terminal.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <memory>

namespace locus {

namespace {

using namespace locus::evaluate;

const std::map<std::string, Alignment> alignments{
    {"none", Alignment::none}, {"yaw", Alignment::yaw}, {"se3", Alignment::se3}, {"sim3", Alignment::sim3}};

struct EvaluateOptions {
    std::string truth, estimate, target, svg;
    Selection selection;
    Alignment alignment = Alignment::none;
    bool json = false;
};

std::string nothing_compared(const Track& truth, const Track& estimate, const Association& association) {
    return fmt::format("no pose can be compared: the truth is from {:.3f} s to {:.3f} s, the estimate from {:.3f} s to "
                       "{:.3f} s; {} poses outside the truth's time, {} in its gaps, {} not selected",
                       truth.front().time_s, truth.back().time_s, estimate.front().time_s, estimate.back().time_s,
                       association.outside_truth, association.in_gap, association.not_selected);
}

Evaluation evaluation(const Track& truth, const Track& estimate, const EvaluateOptions& options) {
    Evaluation result;
    result.association = associate(truth, estimate, options.selection);
    const auto& pairs = result.association.pairs;
    if (pairs.empty()) throw std::invalid_argument(nothing_compared(truth, estimate, result.association));
    result.alignment = options.alignment;
    result.similarity = align(pairs, options.alignment);
    result.statistics = statistics(pairs, result.similarity);
    return result;
}

void write_plot(const Track& truth, const Evaluation& result, const EvaluateOptions& options) {
    const auto file_name = [](const std::string& path) { return std::filesystem::path(path).filename().string(); };
    std::ofstream stream(options.svg);
    stream << plot(truth, result.association.pairs, result.similarity,
                   fmt::format("{} against {}", file_name(options.estimate), file_name(options.truth)));
    stream.close();
    if (!stream) throw FileError(fmt::format("{}: the picture cannot be written", options.svg));
}

void run(const EvaluateOptions& options) {
    const Track truth = read_truth(options.truth), estimate = read_estimate(options.estimate, options.target);
    const Evaluation result = evaluation(truth, estimate, options);
    if (!options.svg.empty()) write_plot(truth, result, options);
    if (options.json)
        fmt::print("{}\n", report_json(result).dump());
    else
        tools::print_lines(report_lines(result));
}

int run_or_complain(const EvaluateOptions& options) {
    try {
        run(options);
        return exit_yes;
    } catch (const std::exception& error) {
        tools::complain(error.what());
        return exit_usage;
    }
}

void add_options(CLI::App& app, EvaluateOptions& options) {
    app.add_option("TRUTH", options.truth, "Truth as a TUM file: t x y z qx qy qz qw")->required();
    app.add_option("ESTIMATE", options.estimate, "Estimate as a TUM file, or as POSE lines of `watch --json`")
        ->required();
    app.add_option("--target", options.target, "The target, where POSE lines are of several")->type_name("NAME");
    app.add_option("--align", options.alignment, "Lay the estimate on the truth first: none, yaw, se3 or sim3")
        ->transform(CLI::CheckedTransformer(alignments))
        ->type_name("HOW")
        ->default_str("none");
    app.add_option("--max-gap", options.selection.max_gap_s, "Longest gap in the truth that is interpolated over")
        ->type_name("S")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    app.add_option("--from", options.selection.from_s, "Compare from this time on")->type_name("T");
    app.add_option("--to", options.selection.to_s, "Compare up to this time")->type_name("T");
    app.add_option("--min-z", options.selection.min_truth_z_m, "Compare only where the truth is this high: airborne")
        ->type_name("Z");
    app.add_option("--svg", options.svg, "Write a picture of the tracks and of the errors")->type_name("FILE");
    app.add_flag("--json", options.json, "Print one JSON object, lengths in metres");
}

} // namespace

void add_evaluate(CLI::App& root, int& exit_code) {
    auto options = std::make_shared<EvaluateOptions>();
    CLI::App& app = *root.add_subcommand("evaluate", "Says how far an estimate was from the truth");
    add_options(app, *options);
    app.footer(
        "The truth is interpolated at the time of each pose. Where poses carry a 95 % bound, the share of errors\n"
        "within it is given as well.\n"
        "Examples:\n  locus evaluate vicon.tum poses.tum --min-z 0.25 --svg flight.svg\n"
        "  locus evaluate truth.tum slam.tum --align sim3 --json | jq .spatial.rmse_m\n"
        "Exit codes: 0 compared, 2 a file cannot be read or nothing in it can be compared.");
    app.callback([options, &exit_code] { exit_code = run_or_complain(*options); });
}

} // namespace locus
