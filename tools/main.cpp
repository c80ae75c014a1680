// locus: the one command that looks after the daemon.
#include "tools/command.h"

#include <array>

namespace {
constexpr std::array<locus::AddCommand, 0> commands{};
}

int main(int argc, char** argv) {
    CLI::App app{"locus looks after the positioning daemon locusd"};
    app.require_subcommand(1);
    int exit_code = locus::exit_yes;
    for (const auto add : commands) add(app, exit_code);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const int code = app.exit(error);
        return code == 0 ? locus::exit_yes : locus::exit_usage;
    }
    return exit_code;
}
