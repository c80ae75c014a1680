// YAML -> Settings. Every problem of a file is found in one go; with any problem there are no settings.
#pragma once

#include "config/settings.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace locus {

/// Kinds are told apart in the message: unknown key (with the nearest valid name), wrong type, out of range, missing.
struct ConfigProblem {
    std::string file;
    int line = 0;   ///< from 1; 0: the file as a whole
    int column = 0; ///< from 1
    std::string message;
};

struct LoadResult {
    std::optional<Settings> settings; ///< empty when there is any problem
    std::vector<ConfigProblem> problems;
    bool readable = true; ///< false: the file could not be opened at all
};

/// With the radio maps that it names, which load_settings_text() leaves alone: it knows no folder.
LoadResult load_settings(const std::string& path);
LoadResult load_settings_text(std::string_view yaml, const std::string& file_name);

/// "file:line:column: message".
std::string to_string(const ConfigProblem& problem);

/// Every value, also the defaults, as YAML that loads to the same settings.
std::string print_settings(const Settings& settings);

/// The reference page (Markdown) of every option there is.
std::string reference_page();

} // namespace locus
