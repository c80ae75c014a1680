// locus replay: a recording through the very engine that the daemon runs.
#include "tools/replay/replay.h"
#include "tools/client/command.h"
#include "tools/settings_file.h"
#include "tools/show/terminal.h"

#include <fmt/format.h>

#include <memory>

namespace locus {
namespace {

using tools::complain;

struct ReplayOptions {
    replay::Request request;
    std::string config;
    double rate_hz = 0;
    double smooth_lag_s = 0;
    bool json = false;
};

std::optional<Settings> settings_of(const ReplayOptions& options) {
    auto settings = tools::settings_of_file(options.config);
    if (!settings) return settings;
    if (options.rate_hz > 0) settings->engine.fusion.rate_hz = options.rate_hz;
    if (options.smooth_lag_s > 0) settings->engine.fusion.smooth_lag_s = options.smooth_lag_s;
    return settings;
}

int tell(const replay::Summary& summary, const ReplayOptions& options) {
    if (options.json)
        fmt::print("{}\n", summary_json(summary));
    else
        tools::print_lines(summary_lines(summary));
    if (summary.has_poses()) return exit_yes;
    complain(fmt::format("no pose from '{}'", options.request.recording));
    for (const auto& sentence : what_is_missing(summary)) complain("  " + sentence);
    return exit_no;
}

int run(const ReplayOptions& options) {
    const auto settings = settings_of(options);
    if (!settings) return exit_usage;
    try {
        return tell(replay::replay(*settings, options.request), options);
    } catch (const std::exception& error) {
        complain(error.what());
        return exit_usage;
    }
}

} // namespace

void add_replay(CLI::App& root, int& exit_code) {
    auto options = std::make_shared<ReplayOptions>();
    CLI::App& app = *root.add_subcommand("replay", "Runs a recording through the engine, as fast as it goes");
    app.add_option("FILE", options->request.recording, "Recording: .jsonl (measurements) or .log (raw input)")
        ->required();
    app.add_option("--config", options->config, "Configuration: the site, the inputs' decoders, the estimator")
        ->required()
        ->type_name("FILE");
    app.add_option("--poses", options->request.pose_files, "Write poses here, .tum or .jsonl; can be given again")
        ->allow_extra_args(false)
        ->type_name("FILE");
    app.add_option("--target", options->request.target, "Only the poses of this target")->type_name("NAME");
    app.add_option("--rate", options->rate_hz, "Poses per second; left out: fusion.rate_hz of the configuration")
        ->check(CLI::Range(1.0, 1000.0))
        ->type_name("HZ");
    app.add_flag("--smooth", options->request.smooth,
                 "Poses that know what came after them as well: for evaluation and maps, not for live use");
    app.add_option("--smooth-lag", options->smooth_lag_s,
                   "Write the poses that locusd gives so much later (SMOOTHED; fusion.smooth_lag_s)")
        ->check(CLI::Range(0.001, 5.0))
        ->excludes("--smooth")
        ->type_name("S");
    app.add_flag("--json", options->json, "Print the summary as JSON");
    app.footer("Example:\n  locus replay flight.jsonl --config hall.yaml --poses flight.tum\n"
               "The same recording and configuration give the same bytes, every time.\n"
               "Exit codes: 0 there are poses, 1 there is none (it says why), 2 a file cannot be used.");
    app.callback([options, &exit_code] {
        options->request.lagged = options->smooth_lag_s > 0;
        exit_code = run(*options);
    });
}

} // namespace locus
