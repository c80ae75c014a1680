// The subcommands of `locus`: one file each, one row in main.cpp. A command sets exit_code from its callback.
// Exit codes: 0 yes, 1 no (a check failed, no fix in time), 2 wrong use or unreadable file, 3 the daemon cannot be
// reached.
#pragma once

#include <CLI/CLI.hpp>

namespace locus {

enum ExitCode : int { exit_yes = 0, exit_no = 1, exit_usage = 2, exit_no_daemon = 3 };

using AddCommand = void (*)(CLI::App& root, int& exit_code);

// Of the running daemon, through its socket.
void add_status(CLI::App& root, int& exit_code);
void add_sources(CLI::App& root, int& exit_code);
void add_targets(CLI::App& root, int& exit_code);
void add_watch(CLI::App& root, int& exit_code);
void add_wait(CLI::App& root, int& exit_code);
void add_reload(CLI::App& root, int& exit_code);
void add_view(CLI::App& root, int& exit_code);

// Of files, without a daemon.
void add_evaluate(CLI::App& root, int& exit_code);
void add_import(CLI::App& root, int& exit_code);
void add_replay(CLI::App& root, int& exit_code);
void add_simulate(CLI::App& root, int& exit_code);
void add_play(CLI::App& root, int& exit_code);
void add_check(CLI::App& root, int& exit_code);
void add_config(CLI::App& root, int& exit_code);
void add_calibrate(CLI::App& root, int& exit_code);
void add_survey(CLI::App& root, int& exit_code);

// Of the devices themselves.
void add_record(CLI::App& root, int& exit_code);
void add_sniff(CLI::App& root, int& exit_code);

// Of the command line itself.
void add_completion(CLI::App& root, int& exit_code);

} // namespace locus
