// Bytes as hex digits without separators, as recordings hold them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace locus {

inline constexpr std::string_view hex_digits = "0123456789ABCDEF";

void append_hex(std::string& text, std::span<const std::uint8_t> data);

/// A number of at most eight hex digits; false when there is none or something else stands there.
bool parse_hex_number(std::string_view hex, std::uint32_t& number);

/// Appends to `data`. False, with a sentence, when there are more than `limit` bytes or other characters.
bool parse_hex_bytes(std::string_view hex, std::size_t limit, std::vector<std::uint8_t>& data, std::string& error);

} // namespace locus
