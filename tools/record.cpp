// locus record: raw bytes and frames of every input, on one clock, into a file that can be replayed.
#include "tools/client/command.h"
#include "tools/command.h"
#include "tools/recorder/counts.h"
#include "tools/recorder/session.h"
#include "tools/settings_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>

namespace locus {
namespace {

using namespace locus::tools;
using namespace std::chrono_literals;
using std::chrono::steady_clock;

struct RecordOptions {
    std::string config;
    std::string output;
    double seconds = 0; ///< 0: until a signal
    bool force = false;
    bool json = false;
};

/// SIGINT and SIGTERM, held back in this and all later threads, waited for instead of interrupting anything.
class StopSignals {
  public:
    StopSignals() {
        ::sigemptyset(&signals_);
        ::sigaddset(&signals_, SIGINT);
        ::sigaddset(&signals_, SIGTERM);
        ::pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
    }
    /// Whether one came within the time.
    bool wait(std::chrono::nanoseconds time) const {
        const auto seconds = std::chrono::floor<std::chrono::seconds>(time);
        const timespec timeout{seconds.count(), (time - seconds).count()};
        return ::sigtimedwait(&signals_, nullptr, &timeout) > 0;
    }

  private:
    sigset_t signals_{};
};

void tell(const std::string& input, const InputEvent& event) {
    using Kind = InputEvent::Kind;
    const std::string text{event.text};
    switch (event.kind) {
    case Kind::opened:
        return complain(input + ": open");
    case Kind::ended:
        return complain(input + ": at its end");
    case Kind::trouble:
        return complain(input + ": " + (text.empty() ? "well again" : text));
    case Kind::lost:
    case Kind::unavailable:
        return complain(input + ": " + text);
    }
}

/// False when the file could not be written any more.
bool record_until_stopped(RecordSession& session, LogFile& file, const StopSignals& signals, double seconds) {
    const auto begin = steady_clock::now();
    bool written = true;
    const auto left = [&] {
        const auto unlimited = std::chrono::nanoseconds{200ms};
        if (seconds <= 0) return unlimited;
        return std::min(unlimited, duration_from_s(seconds) - (steady_clock::now() - begin));
    };
    while (written && !session.ended() && left() > 0ns && !signals.wait(left())) written = file.flush();
    session.stop();
    return file.flush() && written;
}

int finish(const RecordSession& session, const RecordOptions& options, bool written) {
    options.json ? print_counts_json(session, options.output) : print_counts(session);
    if (!written) complain(fmt::format("'{}' is not complete: is the disk full?", options.output));
    std::uint64_t packets = 0;
    for (const auto& part : session.parts()) packets += part->input.status().packets;
    if (packets == 0) complain("nothing came");
    return written && packets > 0 ? exit_yes : exit_no;
}

int record(const RecordOptions& options) {
    const auto settings = settings_of_file(options.config);
    if (!settings) return exit_usage;
    LogFile file;
    std::string error;
    if (!file.open(options.output, options.force, error)) {
        complain(error);
        return exit_usage;
    }
    const StopSignals signals;
    RecordSession session{settings->inputs, file, tell};
    const bool written = record_until_stopped(session, file, signals, options.seconds);
    return finish(session, options, written);
}

} // namespace

void add_record(CLI::App& root, int& exit_code) {
    auto options = std::make_shared<RecordOptions>();
    CLI::App& app = *root.add_subcommand("record", "Records the raw input of every device, for replay");
    app.add_option("--config", options->config, "Configuration whose inputs are opened")->required()->type_name("FILE");
    app.add_option("-o,--output", options->output, "Recording to write (.log)")->required()->type_name("FILE");
    app.add_option("--seconds", options->seconds, "Stop after so long; left out: with Ctrl-C")
        ->type_name("S")
        ->check(CLI::PositiveNumber);
    app.add_flag("--force", options->force, "Overwrite the file when it is there already");
    app.add_flag("--json", options->json, "Print the counts as one JSON object");
    app.footer(
        "It opens the devices itself: stop locusd first, or have it record as it works: locusd --record hall.log\n"
        "Example:\n  locus record --config /etc/locusd/locusd.yaml -o hall.log --seconds 60\n"
        "  locus replay hall.log --config /etc/locusd/locusd.yaml --poses hall.tum\n"
        "CAN lines are candump's format: `canplayer -I hall.log vcan0=uwb` plays those of input uwb\n"
        "(it takes names of up to 15 letters only).\n"
        "Exit codes: 0 recorded, 1 nothing came or the disk is full, 2 wrong use or configuration.");
    app.callback([options, &exit_code] { exit_code = record(*options); });
}

} // namespace locus
