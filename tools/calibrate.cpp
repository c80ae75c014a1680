// locus calibrate: what a site's settings say of its anchors and cameras, measured instead of taped.
#include "tools/calibrate/anchors.h"
#include "tools/calibrate/bias.h"
#include "tools/calibrate/camera.h"
#include "tools/client/command.h"
#include "tools/settings_file.h"
#include "tools/show/terminal.h"

#include <fmt/format.h>

#include <unistd.h>

#include <iostream>
#include <map>
#include <memory>

namespace locus {
namespace {

using namespace calibrate;
using tools::complain;

struct AnchorsOptions {
    AnchorsRequest request;
    bool above = false, below = false, merge = false, json = false;
};

bool asked_at_a_terminal() { return ::isatty(STDIN_FILENO) == 1 && tools::on_terminal(); }

bool is_by_height(const uwb::survey::Survey& survey) { return survey.mirror && survey.mirror->by_height; }

/// Asks until one of the two is typed; what is left at the end of input is no answer.
std::optional<Side> ask(const uwb::survey::Survey& survey, const MeasuredPairs& measured) {
    const bool upright = is_by_height(survey);
    const std::array words{upright ? "above" : "left", upright ? "below" : "right"};
    fmt::print("{}\n", question_of(survey, measured));
    for (std::string answer;
         fmt::print("{} or {}: ", words[0], words[1]), std::cout.flush(), std::getline(std::cin, answer);)
        for (std::size_t i = 0; i < 2; ++i)
            if (!answer.empty() && std::string_view(words[i]).starts_with(answer)) return answers_of(survey)[i];
    return {};
}

std::optional<uwb::survey::Image> settled(const uwb::survey::Survey& survey, const MeasuredPairs& measured,
                                          AnchorsRequest& request) {
    if (auto image = chosen(survey, request)) return image;
    if (asked_at_a_terminal()) {
        (is_by_height(survey) ? request.over_it : request.beside) = ask(survey, measured);
        return chosen(survey, request);
    }
    complain(question_of(survey, measured));
    complain(is_by_height(survey) ? "Say --above or --below." : "Say --mirror left or --mirror right.");
    return {};
}

void print(const uwb::survey::Survey& survey, const uwb::survey::Image& image, const MeasuredPairs& measured,
           bool json) {
    if (json) return fmt::print("{}\n", report_json(image, measured).dump());
    tools::print_lines(report_lines(survey, image, measured));
    fmt::print("\n");
    tools::print_lines(yaml_lines(image, measured));
}

int survey_anchors(AnchorsOptions& options) {
    AnchorsRequest& request = options.request;
    if (options.above || options.below) request.over_it = options.above ? Side::above : Side::below;
    std::optional<Settings> settings;
    if (!request.config.empty()) {
        settings = tools::settings_of_file(request.config);
        if (!settings) return exit_usage;
    }
    const MeasuredPairs measured = read_pairs(request.file, settings, request.sigma_m);
    const uwb::survey::Task task = task_of(request, measured);
    const uwb::survey::Survey survey = uwb::survey::survey(task);
    if (survey.trouble != uwb::survey::Trouble::none) {
        complain(sentence_of(survey, measured, task.dimensions()));
        return exit_no;
    }
    const auto image = settled(survey, measured, request);
    if (!image) return exit_no;
    if (const auto sentences = not_told(*image, measured); !sentences.empty()) {
        for (const auto& sentence : sentences) complain(sentence);
        return exit_no;
    }
    print(survey, *image, measured, options.json);
    if (options.merge) merge_into(request.config, edits_of(*image, measured));
    return exit_yes;
}

struct BiasOptions {
    BiasRequest request;
    bool merge = false, json = false;
};

int calibrate_biases(BiasOptions& options) {
    const BiasRequest& request = options.request;
    const auto settings = tools::settings_of_file(request.config);
    if (!settings) return exit_usage;
    const BiasReport report = calibrate_bias(request, *settings);
    const auto edits = edits_of(report, request);
    if (options.json)
        fmt::print("{}\n", report_json(report).dump());
    else {
        tools::print_lines(report_lines(report, request));
        fmt::print("\n");
        if (!edits.empty()) tools::print_lines(yaml_lines(report, request));
    }
    if (edits.empty()) {
        complain("this walk tells no bias: walk farther about between the anchors, and up and down where they hang in "
                 "one plane");
        return exit_no;
    }
    if (options.merge) merge_into(request.config, edits);
    return exit_yes;
}

template <class Options>
int run_calibration(Options& options, int (*work)(Options&)) {
    try {
        if (options.merge && options.request.config.empty())
            throw std::runtime_error("--merge writes into the settings: name them with --config");
        return work(options);
    } catch (const std::exception& error) {
        complain(error.what());
        return exit_usage;
    }
}

void add_anchors(CLI::App& calibrate, int& exit_code) {
    auto options = std::make_shared<AnchorsOptions>();
    AnchorsRequest& request = options->request;
    CLI::App& app = *calibrate.add_subcommand("anchors", "Where the anchors stand, from their distances to each other");
    app.add_option("FILE", request.file,
                   "Lines a,b,range_m[,sigma_m], or a recording (.jsonl, .log) in which anchors range")
        ->required();
    app.add_option("--config", request.config, "Settings with the anchors' names, known positions and heights")
        ->type_name("FILE");
    app.add_option("--known", request.known, "Anchors whose position in the settings is right: three, not in one line")
        ->delimiter(',')
        ->type_name("NAME,...");
    auto* heights = app.add_flag("--heights", request.heights, "Every anchor's z in the settings is right");
    app.add_option("--height", request.height_m, "All anchors hang at this height")->excludes(heights)->type_name("M");
    app.add_option("--sigma-m", request.sigma_m, "Standard deviation of a distance that says none of its own")
        ->check(CLI::Range(0.0001, 100.0))
        ->capture_default_str();
    static const std::map<std::string, Side> sides{{"left", Side::left}, {"right", Side::right}};
    app.add_option("--mirror", request.beside, "Which of two mirror images, seen from above: left or right")
        ->transform(CLI::CheckedTransformer(sides))
        ->type_name("SIDE");
    auto* above =
        app.add_flag("--above", options->above, "Which of two mirror images: the anchor asked about is above");
    app.add_flag("--below", options->below, "Or below")->excludes(above);
    app.add_flag("--merge", options->merge, "Write the positions into the settings of --config; comments stay");
    app.add_flag("--json", options->json, "Print one JSON object");
    app.footer(
        "Examples:\n  locus calibrate anchors distances.csv --config hall.yaml --known NW,NE,SE\n"
        "  locus calibrate anchors walkabout.jsonl --config hall.yaml --heights --mirror left --merge\n"
        "Without --known the first anchor is the origin, the second lies on +x and the third beside it.\n"
        "Distances cannot tell a site from its mirror image: where they leave two, it asks.\n"
        "Exit codes: 0 surveyed, 1 the distances do not tell (it says what to measure), 2 a file cannot be used.");
    app.callback([options, &exit_code] { exit_code = run_calibration(*options, survey_anchors); });
}

void add_bias(CLI::App& calibrate, int& exit_code) {
    auto options = std::make_shared<BiasOptions>();
    BiasRequest& request = options->request;
    CLI::App& app = *calibrate.add_subcommand("bias", "By how much each anchor's ranges are off, from a recorded walk");
    app.add_option("FILE", request.file, "Recording with two-way ranges: .jsonl (measurements) or .log (raw input)")
        ->required();
    app.add_option("--config", request.config, "Settings: the site, the inputs' decoders")
        ->required()
        ->type_name("FILE");
    app.add_option("--truth", request.truth, "Where the tag's antenna was, if that was surveyed (TUM)")
        ->type_name("FILE");
    app.add_option("--target", request.target, "Whose ranges, where they are of several")->type_name("NAME");
    app.add_option("--sigma-m", request.sigma_m,
                   "Standard deviation of a range where neither device nor anchor says it")
        ->check(CLI::Range(0.001, 100.0))
        ->capture_default_str();
    app.add_option("--acceleration", request.walk.acceleration_mps2, "How fast the tag changes its velocity, m/s2")
        ->check(CLI::Range(0.01, 100.0))
        ->capture_default_str();
    app.add_option("--common-m", request.walk.common_prior_m,
                   "What all biases may have in common, 1 sigma, before the walk")
        ->check(CLI::Range(0.001, 1000.0))
        ->capture_default_str();
    app.add_option("--own-m", request.walk.own_prior_m,
                   "How far one bias may be from the others, 1 sigma, before the walk")
        ->check(CLI::Range(0.001, 1000.0))
        ->capture_default_str();
    app.add_flag("--merge", options->merge, "Write range_bias_m into the settings of --config; comments stay");
    app.add_flag("--json", options->json, "Print one JSON object");
    app.footer("Example:\n  locus calibrate bias walk.jsonl --config hall.yaml --merge\n"
               "Walk about between the anchors for two minutes, and hold the tag high and low.\n"
               "What it finds takes the place of range_bias_m in the settings, it is not added to it.\n"
               "Exit codes: 0 there are biases, 1 the walk tells none, 2 a file cannot be used.");
    app.callback([options, &exit_code] { exit_code = run_calibration(*options, calibrate_biases); });
}

} // namespace

void add_calibrate(CLI::App& root, int& exit_code) {
    CLI::App& app = *root.add_subcommand(
        "calibrate", "Finds where anchors stand, by how much their ranges are off, and how cameras see the floor");
    app.require_subcommand(1);
    app.footer(
        "`locus calibrate anchors --help`, `... bias --help` and `... camera --help` tell more; docs/calibrate.md and "
        "docs/cameras.md tell all.");
    add_anchors(app, exit_code);
    add_bias(app, exit_code);
    add_camera(app, exit_code);
}

} // namespace locus
