// locusd: measurements in, one pose per target and tick out.
// Exit codes: 0 stopped as asked (or --check found nothing), 1 cannot run, 2 wrong use or a configuration with
// mistakes.
#include "config/load.h"
#include "daemon/log.h"
#include "daemon/realtime.h"
#include "daemon/service.h"
#include "daemon/signals.h"
#include "daemon/socket/answers.h"

#include <CLI/CLI.hpp>
#include <spdlog/spdlog.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <stdexcept>

namespace {

enum ExitCode : int { exit_stopped = 0, exit_cannot_run = 1, exit_wrong = 2 };

struct Arguments {
    std::string config = "/etc/locusd/locusd.yaml";
    std::string record;
    bool check = false;
};

/// Empty when the configuration cannot be used; stderr says why.
std::optional<locus::Settings> read_settings(const std::string& path) {
    auto loaded = locus::load_settings(path);
    for (const auto& problem : loaded.problems) std::fprintf(stderr, "%s\n", locus::to_string(problem).c_str());
    return std::move(loaded.settings);
}

/// Settings that load may still not work together; the engine knows.
int check(const std::string& path, const locus::Settings& settings) {
    const locus::Engine engine{settings.engine};
    std::printf("%s: no mistakes found\n", path.c_str());
    return exit_stopped;
}

locus::Listener listen(const locus::Settings& settings) {
    auto inherited = locus::Listener::inherit();
    return inherited ? std::move(*inherited) : locus::Listener::bind(settings.publish.socket);
}

/// Null when none is asked for. Throws std::runtime_error.
std::unique_ptr<locus::LogFile> recording(const std::string& path) {
    if (path.empty()) return nullptr;
    auto file = std::make_unique<locus::LogFile>();
    std::string error;
    if (!file->open(path, false, error)) throw std::runtime_error(error);
    return file;
}

/// SIGUSR2 stops the fusion thread's work, so that the rig sees the watchdog bite; only where the environment asks.
locus::Signals signals() {
    if (std::getenv("LOCUSD_DEBUG_STALL_SIGNAL")) return locus::Signals{SIGTERM, SIGINT, SIGHUP, SIGUSR2};
    return locus::Signals{SIGTERM, SIGINT, SIGHUP};
}

int serve(const Arguments& arguments, locus::Settings settings) {
    const locus::Signals wanted = signals(); // before the first thread
    locus::use_small_stacks();
    locus::start_log(settings.log.level);
    const auto record = recording(arguments.record);
    locus::Listener listener = listen(settings);
    spdlog::info("locusd {} starts with {}", locus::release(), arguments.config);
    {
        locus::Service service{std::move(settings), arguments.config, std::move(listener), record.get()};
        service.run(wanted);
    }
    spdlog::info("stopped");
    locus::end_log();
    return exit_stopped;
}

int run(const Arguments& arguments) {
    auto settings = read_settings(arguments.config);
    if (!settings) return exit_wrong;
    try {
        return arguments.check ? check(arguments.config, *settings) : serve(arguments, std::move(*settings));
    } catch (const std::invalid_argument& error) {
        std::fprintf(stderr, "%s: %s\n", arguments.config.c_str(), error.what());
        return exit_wrong;
    }
}

} // namespace

int main(int argc, char** argv) try {
    Arguments arguments;
    CLI::App app{"locusd: real-time positioning daemon"};
    app.add_option("--config", arguments.config, "Configuration file")->capture_default_str();
    app.add_option("--record", arguments.record, "Also keep all raw input in this file, for locus replay (.log)");
    app.add_flag("--check", arguments.check, "Say what is wrong with the configuration, and start nothing");
    app.set_version_flag("--version", std::string{locus::release()});
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_stopped : exit_wrong;
    }
    return run(arguments);
} catch (const std::exception& error) {
    std::fprintf(stderr, "locusd: %s\n", error.what());
    return exit_cannot_run;
}
