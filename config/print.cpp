// Settings as a file that loads to the same settings.
#include "config/print_options.h"
#include "config/section.h"

#include <fmt/format.h>

namespace locus {

std::string print_settings(const Settings& settings) {
    using namespace config;
    std::string text = print_site(settings.engine.site) + print_targets(settings.engine.targets) +
                       print_inputs(settings.inputs) + print_cameras(settings.cameras) +
                       print_estimators(settings.engine.estimators);
    Settings copy = settings; // FlatSection reaches in for the loader as well, which writes
    for (const auto& section : flat_sections()) {
        const ShownOptions table[]{{section.rows, section.settings(copy)}};
        text += fmt::format("{}:\n{}", section.name, print_block(table, 2));
    }
    return text;
}

} // namespace locus
