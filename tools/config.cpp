// locus config: what a settings file comes to with all defaults filled in, and the page of every setting there is.
#include "config/load.h"
#include "tools/command.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>

namespace locus {
namespace {

struct ConfigOptions {
    std::string file = "/etc/locusd/locusd.yaml";
    bool print = false;
    bool reference = false;
};

int print(const std::string& file) {
    const auto result = load_settings(file);
    for (const auto& problem : result.problems) fmt::print(stderr, "{}\n", to_string(problem));
    if (!result.readable) return exit_usage;
    if (!result.settings) return exit_no;
    fmt::print("{}", print_settings(*result.settings));
    return exit_yes;
}

int run(const ConfigOptions& options) {
    if (!options.reference) return print(options.file);
    fmt::print("{}", reference_page());
    return exit_yes;
}

} // namespace

void add_config(CLI::App& root, int& exit_code) {
    auto options = std::make_shared<ConfigOptions>();
    CLI::App& app = *root.add_subcommand("config", "Prints settings with all defaults, or the reference page");
    auto* file = app.add_option("file", options->file, "Settings file")->type_name("FILE")->capture_default_str();
    auto* print_flag = app.add_flag("--print", options->print, "Print every value of the file, also the defaults");
    app.add_flag("--reference", options->reference, "Print the Markdown page of every setting there is")
        ->excludes(print_flag)
        ->excludes(file);
    app.footer("Example:\n  locus config --print hall.yaml\n  locus config --reference > docs/settings.md\n"
               "Exit codes: 0 printed, 1 the file has problems, 2 it cannot be read.");
    app.callback([options, &exit_code] { exit_code = run(*options); });
}

} // namespace locus
