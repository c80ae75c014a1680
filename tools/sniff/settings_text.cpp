#include "tools/sniff/settings_text.h"

#include "config/value.h"

#include <fmt/format.h>

#include <algorithm>

namespace locus::sniff {
namespace {

/// What is typed for an option that must be typed and has no value yet: one that is allowed.
std::string placeholder(const OptionRow& row, const OptionValue& value) {
    const auto* number = std::get_if<double>(&value);
    if (number && !(*number >= row.minimum && *number <= row.maximum)) return config::to_yaml(row.minimum);
    const std::string text = config::to_yaml(value);
    return text.empty() || text == "\"\"" ? "1" : text;
}

bool is_within(const OptionRow& row, const OptionValue& value) {
    if (const auto* number = std::get_if<std::int64_t>(&value))
        return static_cast<double>(*number) >= row.minimum && static_cast<double>(*number) <= row.maximum;
    const auto* text = std::get_if<std::string>(&value);
    return !text || row.choices.empty() || std::ranges::find(row.choices, *text) != row.choices.end();
}

} // namespace

std::vector<std::string> settings_lines(const OptionTable& table, const void* settings) {
    const auto defaults = table.make();
    std::vector<std::string> lines;
    for (const OptionRow& row : table.rows) {
        const std::string value = config::to_yaml(row.get(settings));
        if (value != config::to_yaml(row.get(defaults.get())))
            lines.push_back(fmt::format("{}: {}", row.name, value));
        else if (row.required)
            lines.push_back(fmt::format("{}: {} # {}", row.name, placeholder(row, row.get(settings)), row.about));
    }
    return lines;
}

bool set_option(const OptionTable& table, void* settings, std::string_view name, const OptionValue& value) {
    const auto row = std::ranges::find(table.rows, name, &OptionRow::name);
    if (row == table.rows.end() || !is_within(*row, value)) return false;
    row->set(settings, value);
    return true;
}

} // namespace locus::sniff
