// Option tables as YAML lines, and as tables of a reference page.
#pragma once

#include "fusion/option.h"

#include <span>
#include <string>

namespace locus::config {

/// A table and the struct that its rows are read from.
struct ShownOptions {
    Options rows;
    const void* settings;
    OptionLists lists{};
};

/// "name: value" lines, each behind `indent` blanks; the first behind "- " as well when they are a list's item.
std::string print_block(std::span<const ShownOptions> tables, std::size_t indent, bool list_item = false);

/// "{name: value, name: value}"
std::string print_flow(const ShownOptions& table);

/// For a reference page (Markdown): name, default, what is allowed, and the sentence of every row.
std::string reference_table(const ShownOptions& options);

} // namespace locus::config
