// locus sources: every anchor and input, how it does, and in a sentence why it is not used.
#include "fusion/aid_status.h"
#include "tools/client/command.h"
#include "tools/client/fields.h"
#include "tools/client/source.h"
#include "tools/show/table.h"
#include "tools/show/terminal.h"
#include "tools/show/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace locus {

namespace {

using namespace locus::tools;
using nlohmann::json;

std::string name_or_address(const json& item) {
    const std::string name = text(item, "name");
    return name.empty() ? text(item, "address") : name;
}

/// Of a satellite also what became of its carrier.
std::string use_sentence(const json& source) {
    const std::string carrier = text(source, "carrier");
    const auto known = std::ranges::find(carrier_texts, carrier, &ExclusionText::name);
    return carrier.empty() || known == carrier_texts.end() ? "used" : std::string{known->sentence};
}

std::string verdict(const json& source) {
    if (in_use(source)) return use_sentence(source);
    if (flag(source, "used")) return fmt::format("silent for {}", duration(number(source, "last_used_age_s")));
    const std::string sentence = text(source, "sentence");
    return sentence.empty() ? text(source, "reason") : sentence;
}

std::string used_share(const json& counters) {
    const auto received = number(counters, "received"), used = number(counters, "used");
    if (!received || !used || *received <= 0) return "-";
    return figure(100 * *used / *received, 0);
}

Table source_table(const json& sources) {
    Table table({{"source"},
                 {"kind"},
                 {"Hz", Align::right},
                 {"age", Align::right},
                 {"observed", Align::right},
                 {"innovation", Align::right},
                 {"sigma", Align::right},
                 {"ratio", Align::right},
                 {"used %", Align::right},
                 {"state"}});
    for (const auto& source : sources)
        table.add({name_or_address(source), text(source, "kind"), figure(number(source, "rate_hz"), 1),
                   duration(number(source, "age_s")), figure(number(source, "observation"), 2),
                   figure(number(source, "innovation"), 2), figure(number(source, "innovation_sigma"), 2),
                   figure(number(source, "test_ratio"), 2), used_share(object(source, "counters")), verdict(source)});
    return table;
}

double refused(const json& input) {
    double sum = 0;
    for (const auto& [reason, count] : object(input, "refused").items())
        if (count.is_number()) sum += count.get<double>();
    return sum;
}

double dropped(const json& input) {
    return number(input, "ring_dropped").value_or(0) + number(input, "kernel_dropped").value_or(0);
}

Table input_table(const json& inputs) {
    Table table({{"input"},
                 {"transport"},
                 {"decoder"},
                 {"state"},
                 {"age", Align::right},
                 {"bytes/s", Align::right},
                 {"frames/s", Align::right},
                 {"measured/s", Align::right},
                 {"frames", Align::right},
                 {"refused", Align::right},
                 {"resyncs", Align::right},
                 {"dropped", Align::right},
                 {"reconnects", Align::right}});
    for (const auto& input : inputs)
        table.add({text(input, "name"), text(input, "transport"), text(input, "decoder"), text(input, "state"),
                   duration(number(input, "age_s")), figure(number(input, "bytes_per_s"), 0),
                   figure(number(input, "frames_per_s"), 1), figure(number(input, "measurements_per_s"), 1),
                   figure(number(input, "frames"), 0), figure(refused(input), 0), figure(number(input, "resyncs"), 0),
                   figure(dropped(input), 0), figure(number(input, "reconnects"), 0)});
    return table;
}

// What does not fit a column: the last error, and which frames were refused for what.
void print_remarks(const json& inputs) {
    for (const auto& input : inputs) {
        const std::string error = text(input, "error");
        const std::string last = text(input, "last_error");
        const std::string doing = text(input, "doing");
        if (!doing.empty()) fmt::print("  {}: {}\n", text(input, "name"), doing);
        if (!error.empty()) fmt::print("  {}: {}\n", text(input, "name"), toned(error, Tone::bad));
        if (error.empty() && !last.empty())
            fmt::print("  {}: well again; {} ago: {}\n", text(input, "name"),
                       duration(number(input, "last_error_age_s")), last);
        for (const auto& [reason, count] : object(input, "refused").items())
            if (count.is_number() && count.get<double>() > 0)
                fmt::print("  {}: {} refused as {}\n", text(input, "name"), count.dump(), printable(reason));
    }
}

std::string place(const json& health) {
    std::string place;
    for (const auto& coordinate : list(health, "stands_site_m"))
        place += (place.empty() ? "" : ", ") +
                 (coordinate.is_number() ? fmt::format("{:.2f}", coordinate.get<double>()) : std::string("?"));
    return place;
}

/// Standard deviation of the least certain of the coordinates that are told.
double place_sigma_m(const json& health) {
    const json &at = list(health, "stands_site_m"), &covariance = list(health, "stands_covariance_m2");
    constexpr std::array<std::size_t, 3> diagonal{0, 3, 5};
    double variance_m2 = 0;
    for (std::size_t axis = 0; axis < diagonal.size() && axis < at.size() && diagonal[axis] < covariance.size(); ++axis)
        if (at[axis].is_number() && covariance[diagonal[axis]].is_number())
            variance_m2 = std::max(variance_m2, covariance[diagonal[axis]].get<double>());
    return std::sqrt(variance_m2);
}

std::string health_remark(const json& health) {
    std::string remark = fmt::format("{} for {}: {}", text(health, "state"), duration(number(health, "since_s")),
                                     text(health, "sentence"));
    if (const auto residual_m = number(health, "residual_m"))
        remark += fmt::format("; its ranges are {:+.2f} m off (+-{:.2f})", *residual_m,
                              number(health, "residual_sigma_m").value_or(0));
    if (const auto moved_m = number(health, "moved_m"))
        remark += fmt::format("; moved by {:.2f} m, it seems to stand at [{}] (+-{:.2f})", *moved_m, place(health),
                              place_sigma_m(health));
    return remark;
}

// Anchors that are not well, each with what ails it and what to do.
void print_ailing(const json& sources) {
    for (const auto& source : sources) {
        const json& health = object(source, "health");
        const std::string state = text(health, "state");
        if (!state.empty() && state != "good" && state != "new" && state != "not_heard")
            fmt::print("  {}: {}\n", name_or_address(source), toned(health_remark(health), Tone::bad));
    }
}

int sources(Client& client, bool as_json) {
    const Message answer = client.ask("?SOURCES;\n", "SOURCES");
    if (as_json) {
        fmt::print("{}\n", answer.line);
        return exit_yes;
    }
    const Table anchors = source_table(list(answer.fields, "sources"));
    if (anchors.empty()) fmt::print("no source yet: the site names no anchor\n");
    if (!anchors.empty()) print_lines(anchors.lines());
    print_ailing(list(answer.fields, "sources"));
    fmt::print("\n");
    print_lines(input_table(list(answer.fields, "inputs")).lines());
    print_remarks(list(answer.fields, "inputs"));
    return exit_yes;
}

} // namespace

void add_sources(CLI::App& root, int& exit_code) {
    add_client_command(
        root, exit_code,
        {"sources", "Lists anchors and inputs: how each does, and why it is not used",
         "Print the daemon's SOURCES line as it is",
         "Example:\n  locus sources\n"
         "  locus sources --json | jq -r '.sources[] | select(.used | not) | .name + \": \" + .sentence'\n"
         "\"innovation\" is measured less expected, \"sigma\" the standard deviation that was foreseen for it, "
         "\"ratio\"\n"
         "the innovation over the largest that is accepted: above 1 the measurement was refused.\n"
         "Rates are those of the last seconds. \"resyncs\" counts how often a decoder had to look for the next frame\n"
         "after damage, \"dropped\" what this computer did not fetch in time."},
        sources);
}

} // namespace locus
