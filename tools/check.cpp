// locus check: is this settings file good? Says every problem at once, before the daemon is asked to read it.
#include "config/load.h"
#include "tools/command.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace locus {
namespace {

struct CheckOptions {
    std::string file = "/etc/locusd/locusd.yaml";
    bool json = false;
};

void print_json(const std::string& file, const LoadResult& result) {
    auto problems = nlohmann::json::array();
    for (const auto& problem : result.problems)
        problems.push_back(
            {{"file", problem.file}, {"line", problem.line}, {"column", problem.column}, {"message", problem.message}});
    const nlohmann::json answer{{"file", file}, {"ok", result.settings.has_value()}, {"problems", problems}};
    fmt::print("{}\n", answer.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::string counted(std::size_t count, std::string_view thing) {
    return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

void print_good(const std::string& file, const Settings& settings) {
    fmt::print("{}: good: {}, {}, {}\n", file, counted(settings.engine.site.anchors.size(), "anchor"),
               counted(settings.engine.targets.size(), "target"), counted(settings.inputs.size(), "input"));
    for (const auto& input : settings.inputs)
        if (input.enabled && input.transport->needs_network)
            fmt::print("  input {} uses the network: as a service, locusd needs the drop-in that allows it "
                       "(see README)\n",
                       input.name);
}

int check(const CheckOptions& options) {
    const auto result = load_settings(options.file);
    if (options.json)
        print_json(options.file, result);
    else if (result.settings)
        print_good(options.file, *result.settings);
    else
        for (const auto& problem : result.problems) fmt::print(stderr, "{}\n", to_string(problem));
    if (!result.readable) return exit_usage;
    return result.settings ? exit_yes : exit_no;
}

} // namespace

void add_check(CLI::App& root, int& exit_code) {
    auto options = std::make_shared<CheckOptions>();
    CLI::App& app =
        *root.add_subcommand("check", "Says whether a settings file is good, and if not, all that is wrong");
    app.add_option("file", options->file, "Settings file")->type_name("FILE")->capture_default_str();
    app.add_flag("--json", options->json, "Print one JSON object: file, ok, problems (file, line, column, message)");
    app.footer("Example:\n  locus check hall.yaml && sudo locus reload\n"
               "Exit codes: 0 good, 1 it has problems, 2 it cannot be read.");
    app.callback([options, &exit_code] { exit_code = check(*options); });
}

} // namespace locus
