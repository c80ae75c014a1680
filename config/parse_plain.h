// Plain words of a settings file as values. Numbers do not depend on the locale and are read to the last bit.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace locus::config {

/// true/false, yes/no, on/off; all small, all large, or the first letter large.
std::optional<bool> parse_bool(std::string_view text);

/// Decimal, or hexadecimal with 0x.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// A finite number.
std::optional<double> parse_double(std::string_view text);

} // namespace locus::config
