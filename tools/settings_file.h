// The --config of commands that need its settings and nothing else of it.
#pragma once

#include "config/settings.h"

#include <optional>
#include <string>

namespace locus::tools {

/// Nothing when the file is wrong: what is wrong with it is told on standard error.
std::optional<Settings> settings_of_file(const std::string& path);

} // namespace locus::tools
