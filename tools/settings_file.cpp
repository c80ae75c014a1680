#include "tools/settings_file.h"

#include "config/load.h"
#include "tools/client/command.h"

namespace locus::tools {

std::optional<Settings> settings_of_file(const std::string& path) {
    LoadResult loaded = load_settings(path);
    for (const ConfigProblem& problem : loaded.problems) complain(to_string(problem));
    return std::move(loaded.settings);
}

} // namespace locus::tools
