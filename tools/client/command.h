// What every command that asks the daemon has in common: --socket, --json, an example, and what happens when the
// daemon cannot be reached.
#pragma once

#include "tools/client/client.h"
#include "tools/command.h"

#include <functional>
#include <string>

namespace locus::tools {

struct ClientOptions {
    std::string socket = "/run/locusd/locusd.sock";
    bool json = false;
};

struct CommandText {
    std::string name;
    std::string about;
    std::string json_about; ///< what --json prints
    std::string footer;     ///< examples and exit codes
};

/// Returns the exit code.
using ClientCommand = std::function<int(Client& client, bool json)>;

/// Adds the subcommand and returns it, so that options of its own can be added. A DaemonError ends it with its sentence
/// on standard error and exit code 3.
CLI::App& add_client_command(CLI::App& root, int& exit_code, const CommandText& text, ClientCommand command);

/// Prints a sentence for people on standard error.
void complain(const std::string& sentence);

} // namespace locus::tools
