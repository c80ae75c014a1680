// locus targets: everyone who is to be located, where they are, or what stands in the way.
#include "tools/client/command.h"
#include "tools/client/fields.h"
#include "tools/show/table.h"
#include "tools/show/terminal.h"
#include "tools/show/words.h"

#include <fmt/format.h>

namespace locus {

namespace {

using namespace locus::tools;
using nlohmann::json;

std::vector<std::string> row(const json& target) {
    const auto position = vector3(target, "position_site_m");
    const auto along = [&](std::size_t axis) {
        return figure(position ? std::optional{(*position)[axis]} : std::nullopt, 2);
    };
    return {text(target, "name"),
            along(0),
            along(1),
            along(2),
            figure(number(target, "horizontal_error_95_m"), 2),
            duration(number(target, "age_s")),
            figure(number(target, "reset_count"), 0),
            text(target, "estimator"),
            flag(target, "has_pose") ? "located" : text(target, "missing")};
}

int targets(Client& client, bool as_json) {
    const Message answer = client.ask("?TARGETS;\n", "TARGETS");
    if (as_json) {
        fmt::print("{}\n", answer.line);
        return exit_yes;
    }
    Table table({{"target"},
                 {"x m", Align::right},
                 {"y m", Align::right},
                 {"z m", Align::right},
                 {"±95 % m", Align::right},
                 {"age", Align::right},
                 {"resets", Align::right},
                 {"estimator"},
                 {"state"}});
    for (const auto& target : list(answer.fields, "targets")) table.add(row(target));
    if (table.empty())
        fmt::print("no target yet: none is configured and none has been heard\n");
    else
        print_lines(table.lines());
    return exit_yes;
}

} // namespace

void add_targets(CLI::App& root, int& exit_code) {
    add_client_command(root, exit_code,
                       {"targets", "Lists the targets: where they are, or what stands in the way",
                        "Print the daemon's TARGETS line as it is",
                        "Example:\n  locus targets\n  locus targets --json | jq '.targets[] | select(.has_pose).name'"},
                       targets);
}

} // namespace locus
