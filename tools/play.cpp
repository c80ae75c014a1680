// locus play: the raw input of a recording into the devices of a configuration, at the pace it came, for a daemon that
// listens to them as it would to the real ones.
#include "tools/client/command.h"
#include "tools/play/player.h"
#include "tools/settings_file.h"

#include <fmt/format.h>

#include <memory>
#include <stdexcept>

namespace locus {
namespace {

using tools::complain;

struct PlayOptions {
    play::Request request;
    std::string config;
    bool json = false;
};

int report(const play::Result& result, const PlayOptions& options) {
    if (options.json) {
        fmt::print("{}\n", play::result_json(result));
    } else {
        fmt::print("{} packets in {:.1f} s, {} of them lost because nobody read them\n", result.played, result.took_s,
                   result.lost);
    }
    for (const auto& [name, count] : result.of_unknown_inputs)
        complain(fmt::format("{} lines of '{}' left out: no enabled input has this name", count, name));
    for (const auto& problem : result.problems) complain(problem);
    if (result.played == 0) complain("nothing was played");
    return result.played > result.lost ? exit_yes : exit_no;
}

int run(const PlayOptions& options) {
    const auto settings = tools::settings_of_file(options.config);
    if (!settings) return exit_usage;
    try {
        return report(play::play(settings->inputs, options.request), options);
    } catch (const std::runtime_error& error) {
        complain(error.what());
        return exit_usage;
    }
}

} // namespace

void add_play(CLI::App& root, int& exit_code) {
    auto options = std::make_shared<PlayOptions>();
    CLI::App& app = *root.add_subcommand("play", "Plays a recording's raw input into pseudo-terminals, pipes and CAN");
    app.add_option("FILE", options->request.recording, "Recording: .log (raw input)")->required();
    app.add_option("--config", options->config, "Configuration whose devices are made and fed")
        ->required()
        ->type_name("FILE");
    app.add_option("--speed", options->request.speed, "2: twice as fast as it came")
        ->check(CLI::Range(0.01, 100.0))
        ->capture_default_str();
    app.add_flag("--json", options->json, "Print the counts as one JSON object");
    app.footer(
        "It makes the pseudo-terminals and named pipes of the enabled inputs at their `path`, waits until each has\n"
        "a reader, and sends CAN frames to `interface`. Lines go to the input that has their name.\n"
        "Example:\n  locus play hall.log --config hall.yaml &\n  locusd --config hall.yaml\n"
        "CAN alone needs no locus: `canplayer -I hall.log vcan0=uwb`.\n"
        "Exit codes: 0 it was played, 1 nothing was or nobody read it, 2 a file or a device cannot be used.");
    app.callback([options, &exit_code] { exit_code = run(*options); });
}

} // namespace locus
