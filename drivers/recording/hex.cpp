#include "drivers/recording/hex.h"

#include <charconv>

namespace locus {

void append_hex(std::string& text, std::span<const std::uint8_t> data) {
    for (const std::uint8_t byte : data) {
        text += hex_digits[byte >> 4];
        text += hex_digits[byte & 0xF];
    }
}

bool parse_hex_number(std::string_view hex, std::uint32_t& number) {
    const auto [end, failed] = std::from_chars(hex.data(), hex.data() + hex.size(), number, 16);
    return failed == std::errc{} && end == hex.data() + hex.size();
}

bool parse_hex_bytes(std::string_view hex, std::size_t limit, std::vector<std::uint8_t>& data, std::string& error) {
    if (hex.size() % 2 != 0) error = "half a byte: the number of hex digits is odd";
    if (hex.size() / 2 > limit) error = "more than " + std::to_string(limit) + " bytes in one line";
    for (; error.empty() && !hex.empty(); hex.remove_prefix(2)) {
        std::uint32_t byte = 0;
        if (!parse_hex_number(hex.substr(0, 2), byte)) error = "the data are not hex digits";
        data.push_back(static_cast<std::uint8_t>(byte));
    }
    return error.empty();
}

} // namespace locus
