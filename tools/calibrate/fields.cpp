#include "tools/calibrate/fields.h"

#include <charconv>

namespace locus::calibrate {

std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    for (;;) {
        const auto comma = line.find(',');
        auto field = line.substr(0, comma);
        while (field.starts_with(' ')) field.remove_prefix(1);
        while (field.ends_with(' ') || field.ends_with('\r')) field.remove_suffix(1);
        fields.push_back(field);
        if (comma == std::string_view::npos) return fields;
        line.remove_prefix(comma + 1);
    }
}

std::optional<double> number_of(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.begin(), text.end(), value);
    if (error != std::errc{} || end != text.end()) return {};
    return value;
}

} // namespace locus::calibrate
