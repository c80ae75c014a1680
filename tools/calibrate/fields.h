// Lines of numbers and names with commas between them, as people type them.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace locus::calibrate {

/// At least one, without blanks at their ends.
std::vector<std::string_view> fields_of(std::string_view line);

/// Empty where it is not a number and nothing else.
std::optional<double> number_of(std::string_view text);

} // namespace locus::calibrate
