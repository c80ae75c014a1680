// locus survey: a radio map of somebody who walks about, from recordings or from the running daemon.
#include "config/radio_map.h"
#include "tools/client/command.h"
#include "tools/settings_file.h"
#include "tools/show/terminal.h"
#include "tools/survey/collect.h"
#include "tools/survey/live.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

namespace locus {
namespace {

using tools::complain;

struct SurveyOptions {
    survey::Request request;
    std::string config, output;
    std::string socket = tools::ClientOptions{}.socket;
    std::vector<std::string> targets;
    std::vector<double> at;
    double seconds = 0;
    bool live = false, overwrite = false;
};

/// Reads back what will be written, so that nothing is written that cannot be used.
void check_map(const radio::RadioMap& map) {
    config::Problems problems("the map that was collected");
    if (!config::parse_radio_map(config::radio_map_yaml(map), problems))
        throw std::runtime_error(to_string(problems.take().front()));
}

survey::Collected from_recordings(const SurveyOptions& options) {
    const auto settings = options.config.empty() ? std::optional(Settings{}) : tools::settings_of_file(options.config);
    if (!settings.has_value()) throw std::runtime_error("the settings cannot be used");
    survey::Collected collected = survey::collect(options.request, settings.value());
    if (collected.readings == 0)
        throw std::runtime_error(
            fmt::format("no signal strength with a pose at its time was found ({} without one, {} bad lines)",
                        collected.unplaced, collected.bad_lines));
    return collected;
}

/// What is wrong is said while somebody walks, not when he has come back.
void tell_progress(const survey::LiveProgress& progress, bool stood) {
    const bool blind = !stood && progress.poses == 0 && progress.poses_by_radio > 0;
    const std::string place = stood   ? "standing where --at says"
                              : blind ? "no pose but of signal strength itself: a map cannot be learnt from that"
                                      : fmt::format("{} poses", progress.poses);
    complain(fmt::format("{} readings, {}; Ctrl-C writes the map", progress.readings, place));
}

survey::Collected from_daemon(const SurveyOptions& options) {
    tools::Client client(options.socket);
    const auto& stood_site_m = options.request.stood_site_m;
    const survey::LiveRequest request{options.targets, options.seconds, stood_site_m, options.request.cell_m,
                                      options.request.heading};
    survey::Collected collected = survey::survey_live(client, request, [&](const survey::LiveProgress& progress) {
        tell_progress(progress, stood_site_m.has_value());
    });
    if (collected.readings == 0)
        throw std::runtime_error(
            fmt::format("{} signal strengths were heard, none with a pose at its time: does a target carry the radio "
                        "and a sensor that tells its place (`locus targets`)? Who stands says where with --at",
                        collected.unplaced));
    return collected;
}

void check_options(const SurveyOptions& options) {
    if (!options.overwrite && std::filesystem::exists(options.output))
        throw std::runtime_error("'" + options.output + "' is there already; --force overwrites it");
    if (options.live == !options.request.recordings.empty())
        throw std::runtime_error("give recordings, or --live for the running daemon");
    if (options.live && !options.request.poses.empty())
        throw std::runtime_error("--poses belongs to recordings; the daemon tells its own");
}

void write_map(const SurveyOptions& options) {
    check_options(options);
    const survey::Collected collected = options.live ? from_daemon(options) : from_recordings(options);
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
    } catch (const tools::DaemonError& error) {
        complain(error.what());
        return exit_no_daemon;
    } catch (const std::exception& error) {
        complain(error.what());
        return exit_usage;
    }
}

} // namespace

void add_survey(CLI::App& root, int& exit_code) {
    auto options = std::make_shared<SurveyOptions>();
    options->request.heading.date = config::date_of_today();
    CLI::App& app = *root.add_subcommand("survey", "Makes a radio map of recordings and poses, or of a walk under way");
    app.add_option("FILE", options->request.recordings, "Recordings with signal strengths (.jsonl, .log)");
    app.add_flag("--live", options->live, "Ask the running daemon, until Ctrl-C");
    app.add_option("--target", options->targets, "With --live: only this target; can be given again")
        ->allow_extra_args(false)
        ->type_name("NAME");
    app.add_option("--seconds", options->seconds, "With --live: stop after so long")
        ->check(CLI::PositiveNumber)
        ->type_name("S");
    app.add_option("--socket", options->socket, "With --live: the daemon's socket")
        ->capture_default_str()
        ->type_name("PATH");
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
    app.add_option("--site", options->request.heading.site, "Name of the site, for the file");
    app.add_option("--device", options->request.heading.device, "What it was heard with, for the file");
    app.add_option("--date", options->request.heading.date, "When, for the file; left out: today");
    app.add_flag("--force", options->overwrite, "Overwrite the map when it is there already");
    app.footer("Examples:\n  locus survey --live --target anna --site hall -o hall-map.yaml\n  locus replay walk.log "
               "--config hall.yaml --poses walk.tum\n"
               "  locus survey walk.log --config hall.yaml --poses walk.tum --site hall -o hall-map.yaml\n"
               "Then name hall-map.yaml in the settings: estimators: {radio_particles: {map: hall-map.yaml}}.\n"
               "Exit codes: 0 written, 2 it could not be, 3 the daemon cannot be reached.");
    app.callback([options, &exit_code] { exit_code = run_survey(*options); });
}

} // namespace locus
