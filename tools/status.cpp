// locus status: one screen that says whether positions come out, and if not what is missing.
#include "tools/client/command.h"
#include "tools/client/fields.h"
#include "tools/client/source.h"
#include "tools/show/terminal.h"
#include "tools/show/words.h"

#include <fmt/format.h>

#include <algorithm>

namespace locus {

namespace {

using namespace locus::tools;
using nlohmann::json;

void print_row(std::string_view name, const std::string& text) { fmt::print("  {:<14}{}\n", name, text); }

std::string share(const json& items, bool (*good)(const json&), std::string_view what) {
    return fmt::format("{} of {} {}", std::ranges::count_if(items, good), items.size(), what);
}

void print_headline(const Message& version, const json& status) {
    const bool working = flag(status, "working");
    const std::string state =
        working ? toned("working", Tone::good) : toned("not working: no target has a position", Tone::bad);
    fmt::print("locusd {}, site {}: {}\n", text(version.fields, "release"), text(version.fields, "site"), state);
    if (!working)
        for (const auto& sentence : list(status, "missing"))
            if (sentence.is_string()) fmt::print("  - {}\n", printable(sentence.get_ref<const std::string&>()));
}

void print_flow(const json& sources, const json& targets) {
    print_row("inputs",
              share(list(sources, "inputs"), [](const json& i) { return text(i, "state") == "open"; }, "open"));
    print_row("sources", share(list(sources, "sources"), in_use, "used"));
    print_row("targets",
              share(list(targets, "targets"), [](const json& t) { return flag(t, "has_pose"); }, "have a position"));
}

std::string ticks(const json& status) {
    const json& late = object(status, "tick_late_us");
    return fmt::format("{} at {} Hz, {} overruns; late by {} us (median), {} us (99 %), {} us (maximum)",
                       figure(number(status, "ticks"), 0), figure(number(status, "rate_hz"), 0),
                       figure(number(status, "overruns"), 0), figure(number(late, "p50"), 0),
                       figure(number(late, "p99"), 0), figure(number(late, "max"), 0));
}

std::string measurements(const json& engine) {
    return fmt::format("{} received, {} late, {} refused, {} rolled back", figure(number(engine, "received"), 0),
                       figure(number(engine, "late"), 0), figure(number(engine, "refused"), 0),
                       figure(number(engine, "rolled_back"), 0));
}

std::string scheduling(const json& status) {
    return fmt::format("{}, memory {}", flag(status, "realtime") ? "real time" : "ordinary",
                       flag(status, "memory_locked") ? "locked" : "not locked");
}

int status(Client& client, bool as_json) {
    const Message answer = client.ask("?STATUS;\n", "STATUS");
    if (as_json) {
        fmt::print("{}\n", answer.line);
        return flag(answer.fields, "working") ? exit_yes : exit_no;
    }
    const Message sources = client.ask("?SOURCES;\n", "SOURCES");
    const Message targets = client.ask("?TARGETS;\n", "TARGETS");
    print_headline(client.version(), answer.fields);
    print_flow(sources.fields, targets.fields);
    print_row("measurements", measurements(object(answer.fields, "engine")));
    print_row("ticks", ticks(answer.fields));
    print_row("scheduling", scheduling(answer.fields));
    print_row("clients", figure(number(answer.fields, "clients"), 0));
    print_row("configuration", text(answer.fields, "config"));
    print_row("running for", duration(number(answer.fields, "uptime_s")));
    return flag(answer.fields, "working") ? exit_yes : exit_no;
}

} // namespace

void add_status(CLI::App& root, int& exit_code) {
    add_client_command(root, exit_code,
                       {"status", "Says whether positions come out, and if not what is missing",
                        "Print the daemon's STATUS line as it is",
                        "Example:\n  locus status || locus sources\n"
                        "Exit codes: 0 a target has a position, 1 none has, 3 the daemon cannot be reached."},
                       status);
}

} // namespace locus
