// locus: the one command that looks after the daemon.
#include "tools/command.h"

#include <array>
#include <cstdio>
#include <exception>

namespace {
constexpr auto commands = std::to_array<locus::AddCommand>({
    locus::add_status, locus::add_sources, locus::add_targets,    locus::add_view,     locus::add_watch,
    locus::add_wait,   locus::add_reload,  locus::add_evaluate,   locus::add_record,   locus::add_sniff,
    locus::add_check,  locus::add_config,  locus::add_completion, locus::add_simulate, locus::add_import,
    locus::add_replay, locus::add_play,    locus::add_calibrate,  locus::add_survey,
});
}

int main(int argc, char** argv) try {
    CLI::App app{"locus looks after the positioning daemon locusd"};
    app.require_subcommand(1);
    app.footer("`locus COMMAND --help` shows what a command takes, with an example.\n"
               "Exit codes: 0 yes, 1 no, 2 wrong use or unreadable file, 3 the daemon cannot be reached.");
    int exit_code = locus::exit_yes;
    for (const auto add : commands) add(app, exit_code);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const int code = app.exit(error);
        return code == 0 ? locus::exit_yes : locus::exit_usage;
    }
    return exit_code;
} catch (const std::exception& error) {
    std::fprintf(stderr, "locus: %s\n", error.what());
    return locus::exit_usage;
}
