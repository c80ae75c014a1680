// The reference page: every option there is, from the tables that the loader itself reads by.
#include "config/print_options.h"
#include "config/section.h"
#include "config/value.h"

#include <fmt/format.h>

#include <algorithm>

namespace locus {
namespace config {
namespace {

constexpr std::string_view introduction = R"(# Settings

Made from the option tables: `locus config --reference > docs/settings.md` writes this page anew.

A settings file is one YAML document in UTF-8, by default `/etc/locusd/locusd.yaml`. Whatever is left out has its default,
so a small site needs a few lines; `config/examples/` holds whole files. `locus check FILE` tells everything that is wrong
with a file in one go, `locus config --print FILE` prints every value that is in force, and `sudo locus reload` (or SIGHUP)
has the daemon read the file again; if anything is wrong, the old settings stay.

Units stand in the names: `_m` metres, `_s` seconds, `_hz` hertz, `_deg` degrees, `_bd` baud; `sigma_` is one standard
deviation. `_site` is the site frame: right-handed, metres, z up. An address is what a device calls itself by: a number
(`3`, `0x1234`) or an EUI as printed on the board (`"DE:CA:01:02:03:04:05:06"`). Aliases, anchors and tags of YAML are not
understood.
)";

std::string cell(std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, 1, '\\');
    return text;
}

std::string default_text(const OptionRow& row, const void* settings) {
    if (row.required) return "required";
    const std::string value = to_yaml(row.get(settings));
    return value.empty() || value == "\"\"" ? "" : fmt::format("`{}`", value);
}

std::string allowed_text(const OptionRow& row, const void* settings) {
    if (!row.choices.empty()) return fmt::format("one of {}", fmt::join(row.choices, ", "));
    const std::string limits = limits_text(row);
    return fmt::format("{}{}{}", type_name(row.get(settings)), limits.empty() ? "" : ", ", limits);
}

} // namespace

std::string reference_table(const ShownOptions& options) {
    if (options.rows.empty()) return "\nNo settings of its own.\n";
    std::string text = "\n| setting | default | allowed | |\n|---|---|---|---|\n";
    for (const auto& row : options.rows)
        text += fmt::format("| `{}` | {} | {} | {} |\n", row.name, cell(default_text(row, options.settings)),
                            cell(allowed_text(row, options.settings)), cell(std::string(row.about)));
    return text;
}

namespace {

std::string list_sections() {
    return fmt::format(
        "\n## site\n{}\n### site.anchors\n\nA list; each item:\n{}\n### site.walls\n\nA list, for "
        "estimators that know that nobody walks through a wall; each item:\n{}\n### site.origin\n\nOnly for sites that"
        " have a place on the Earth (GNSS).\n{}\n## targets\n\nA list of the tags that have a name "
        "or an estimator of their own; each item:\n{}\n## inputs\n\nA list. Each item has the settings "
        "below, and beside them, in the same map, those of its transport and of its decoder:\n{}",
        reference_table({site_options, std::make_unique<Site>().get()}),
        reference_table({anchor_options, std::make_unique<Anchor>().get()}),
        reference_table({wall_options, std::make_unique<Wall>().get()}),
        reference_table({origin_options, std::make_unique<Wgs84Anchor>().get()}),
        reference_table({target_options, std::make_unique<TargetSettings>().get()}),
        reference_table({input_options, std::make_unique<InputSettings>().get()}));
}

/// A list's item has no struct of its own to show defaults of, so one is appended to the module's.
std::string module_page(const OptionTable& table) {
    const auto settings = table.make();
    std::string text = reference_table({table.rows, settings.get()});
    for (const auto& list : table.lists)
        text += fmt::format("\n`{}`: {} A list; each item:\n{}", list.name, list.about,
                            reference_table({list.rows, list.append(settings.get())}));
    return text;
}

/// One heading and table for each row of the table of transports, decoders or estimators.
std::string modules(std::string_view kind, const auto& rows) {
    std::string text;
    for (const auto& row : rows)
        text += fmt::format("\n### {} `{}`\n\n{}\n{}", kind, row.name, row.about, module_page(row.options));
    return text;
}

std::string cameras_page() {
    const CameraInputSettings defaults;
    return fmt::format(
        "\n## cameras\n\nA list. Each item has the settings below, and beside them, in the same map, those of its "
        "source; "
        "those of a camera that hangs, of its detector and of the tracker (docs/cameras.md); or those of a camera that "
        "is worn (docs/visual-odometry.md):\n{}\n### camera that hangs\n{}\n### camera that is worn\n{}{}{}\n"
        "### tracker\n{}",
        reference_table({camera_input_options, &defaults}), reference_table({onlooker_options, &defaults}),
        reference_table({camera::odometer_options, &defaults.odometry}),
        modules("source", camera::frame_source_table()), modules("detector", camera::detector_table()),
        reference_table({vision::tracker_options, &defaults.tracker}));
}

std::string section_page(const FlatSection& section) {
    Settings defaults;
    return fmt::format("\n## {}\n\n{}\n{}", section.name, section.about,
                       reference_table({section.rows, section.settings(defaults)}));
}

} // namespace
} // namespace config

std::string reference_page() {
    using namespace config;
    std::string page(introduction);
    page += list_sections() + modules("transport", transport_table()) + modules("decoder", decoder_table());
    page += cameras_page();
    page += "\n## estimators\n\nOne map for each estimator whose settings are not the defaults.\n";
    page += modules("estimator", estimator_table());
    for (const auto& section : flat_sections()) page += section_page(section);
    return page;
}

} // namespace locus
