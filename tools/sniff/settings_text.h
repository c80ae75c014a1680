// Settings as the lines of YAML that somebody would have to type: what is required, and what is not as it comes.
#pragma once

#include "fusion/option.h"

#include <string>
#include <string_view>
#include <vector>

namespace locus::sniff {

/// "name: value" for every row that is required or differs from its default; a required one that still has its default
/// gets its sentence as a comment, because nobody but the reader knows it. Lists are left out.
std::vector<std::string> settings_lines(const OptionTable& table, const void* settings);

/// False when there is no such option, or the value is beyond its limits or choices.
bool set_option(const OptionTable& table, void* settings, std::string_view name, const OptionValue& value);

} // namespace locus::sniff
