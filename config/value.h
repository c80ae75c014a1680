// One YAML value against one option row: the right type, within the limits, or a problem that says what is wrong.
#pragma once

#include "config/yaml_tree.h"
#include "fusion/option.h"

#include <optional>
#include <string>

namespace locus::config {

/// The value as the alternative that `shape` (what row.get() returns) holds; empty after a problem was added.
std::optional<OptionValue> read_value(const YamlNode& node, const OptionRow& row, const OptionValue& shape,
                                      Problems& problems);

/// As YAML that read_value() reads back to the same bits; empty for a number that is not set (NaN).
std::string to_yaml(const OptionValue& value);

/// What a value of this shape is called in messages and on the reference page: "a number", "yes or no", ...
std::string type_name(const OptionValue& shape);

/// "between 1 Hz and 1000 Hz", "at least 0"; empty without limits.
std::string limits_text(const OptionRow& row);

} // namespace locus::config
