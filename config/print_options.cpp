#include "config/print_options.h"
#include "config/value.h"

#include <fmt/format.h>

namespace locus::config {
namespace {

/// "name: value"; empty when the value is not set.
std::string print_row(const OptionRow& row, const void* settings) {
    const std::string value = to_yaml(row.get(settings));
    return value.empty() ? "" : fmt::format("{}: {}", row.name, value);
}

/// "signals:", then one line an item.
std::string print_list(const OptionList& list, const void* settings, std::size_t indent) {
    const std::size_t size = list.size(settings);
    if (size == 0) return "";
    std::string lines = fmt::format("{:{}}{}:\n", "", indent, list.name);
    for (std::size_t i = 0; i < size; ++i)
        lines += fmt::format("{:{}}- {}\n", "", indent + 2, print_flow({list.rows, list.item(settings, i)}));
    return lines;
}

} // namespace

std::string print_block(std::span<const ShownOptions> tables, std::size_t indent, bool list_item) {
    std::string lines;
    for (const auto& table : tables)
        for (const auto& row : table.rows)
            if (const std::string line = print_row(row, table.settings); !line.empty()) {
                const bool dash = list_item && lines.empty();
                lines += fmt::format("{:{}}{}{}\n", "", indent, dash ? "- " : list_item ? "  " : "", line);
            }
    for (const auto& table : tables)
        for (const auto& list : table.lists) lines += print_list(list, table.settings, indent + 2 * list_item);
    return lines;
}

std::string print_flow(const ShownOptions& table) {
    std::string entries;
    for (const auto& row : table.rows)
        if (const std::string entry = print_row(row, table.settings); !entry.empty())
            entries += (entries.empty() ? "" : ", ") + entry;
    return "{" + entries + "}";
}

} // namespace locus::config
