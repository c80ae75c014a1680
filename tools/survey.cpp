// locus survey: a radio map from recordings of somebody who walks about.
#include "config/load.h"
#include "config/radio_map.h"
#include "tools/client/command.h"
#include "tools/settings_file.h"
#include "tools/show/terminal.h"
#include "tools/survey/collect.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>

namespace locus {
namespace {

using tools::complain;

struct SurveyOptions {
    survey::Request request;
    std::string config, output;
    std::vector<double> at;
    bool overwrite = false;
};

/// Reads back what will be written, so that nothing is written that cannot be used.
void check_map(const radio::RadioMap& map) {
    config::Problems problems("the map that was collected");
    if (!config::parse_radio_map(config::radio_map_yaml(map), problems))
        throw std::runtime_error(to_string(problems.take().front()));
}

void write_map(const SurveyOptions& options) {
    if (!options.overwrite && std::filesystem::exists(options.output))
        throw std::runtime_error("'" + options.output + "' is there already; --force overwrites it");
    const auto settings = options.config.empty() ? std::optional(Settings{}) : tools::settings_of_file(options.config);
    if (!settings.has_value()) throw std::runtime_error("the settings cannot be used");
    const survey::Collected collected = survey::collect(options.request, settings.value());
    if (collected.readings == 0)
        throw std::runtime_error(
            fmt::format("no signal strength with a pose at its time was found ({} without one, {} bad "
                        "lines)",
                        collected.unplaced, collected.bad_lines));
    check_map(collected.map);
    config::write_radio_map(options.output, collected.map);
    fmt::print("{} readings of {} beacons at {} points -> {}\n", collected.readings,
               radio::beacons_of(collected.map).size(), collected.map.points.size(), options.output);
    if (collected.unplaced > 0) fmt::print("{} readings left out: no pose at their time\n", collected.unplaced);
    if (collected.bad_lines > 0) fmt::print("{} bad lines passed over\n", collected.bad_lines);
}

int run_survey(SurveyOptions& options) {
    if (options.at.size() == 3) options.request.stood_site_m = Vec3{options.at[0], options.at[1], options.at[2]};
    try {
        write_map(options);
        return exit_yes;
    } catch (const std::exception& error) {
        complain(error.what());
        return exit_usage;
    }
}

std::string today() { return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::chrono::system_clock::now())); }

} // namespace

void add_survey(CLI::App& root, int& exit_code) {
    auto options = std::make_shared<SurveyOptions>();
    options->request.date = today();
    CLI::App& app = *root.add_subcommand("survey", "Makes a radio map of recordings and poses");
    app.add_option("FILE", options->request.recordings, "Recordings with signal strengths (.jsonl, .log)")->required();
    app.add_option(
           "--poses", options->request.poses,
           "Where the radio was: poses of `locus replay` or a truth (TUM), one file for each recording or for all")
        ->type_name("FILE");
    app.add_option("--at", options->at, "Where the radio stood all the time: X Y Z in metres")
        ->expected(3)
        ->type_name("M");
    app.add_option("-o,--output", options->output, "Radio map to write")->required()->type_name("FILE");
    app.add_option("-c,--config", options->config, "Settings: the decoders of raw input, and which radios are anchors")
        ->type_name("FILE");
    app.add_option("--cell", options->request.cell_m, "Width of a cell that becomes a point of the map; left out: 2 m")
        ->check(CLI::Range(0.1, 100.0))
        ->type_name("M");
    app.add_option("--site", options->request.site, "Name of the site, for the file");
    app.add_option("--device", options->request.device, "What it was heard with, for the file");
    app.add_option("--date", options->request.date, "When, for the file; left out: today");
    app.add_flag("--force", options->overwrite, "Overwrite the map when it is there already");
    app.footer("Example:\n  locus replay walk.log --config hall.yaml --poses walk.tum\n"
               "  locus survey walk.log --config hall.yaml --poses walk.tum --site hall -o hall-map.yaml\n"
               "Then name hall-map.yaml in the settings: estimators: {radio_particles: {map: hall-map.yaml}}.\n"
               "Exit codes: 0 written, 2 it could not be.");
    app.callback([options, &exit_code] { exit_code = run_survey(*options); });
}

} // namespace locus
