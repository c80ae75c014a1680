#include "tools/client/command.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>

namespace locus::tools {

void complain(const std::string& sentence) {
    std::fflush(stdout);
    fmt::print(stderr, "locus: {}\n", sentence);
}

namespace {

int run(const ClientOptions& options, const ClientCommand& command) {
    try {
        Client client(options.socket);
        return command(client, options.json);
    } catch (const DaemonError& error) {
        complain(error.what());
        return exit_no_daemon;
    }
}

} // namespace

CLI::App& add_client_command(CLI::App& root, int& exit_code, const CommandText& text, ClientCommand command) {
    auto options = std::make_shared<ClientOptions>();
    CLI::App& app = *root.add_subcommand(text.name, text.about);
    app.add_option("--socket", options->socket, "Path of the daemon's socket")
        ->envname("LOCUS_SOCKET")
        ->type_name("PATH")
        ->capture_default_str();
    if (!text.json_about.empty()) app.add_flag("--json", options->json, text.json_about);
    app.footer(text.footer);
    app.callback([options, command = std::move(command), &exit_code] { exit_code = run(*options, command); });
    return app;
}

} // namespace locus::tools
