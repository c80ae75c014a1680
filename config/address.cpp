#include "config/address.h"

#include <fmt/format.h>

#include <charconv>

namespace locus::config {
namespace {

std::optional<std::uint64_t> parse_number(std::string_view digits, int base) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(digits.begin(), digits.end(), value, base);
    if (error != std::errc{} || end != digits.end()) return std::nullopt;
    return value;
}

std::optional<std::uint64_t> parse_bytes(std::string_view text, char separator) {
    if (text.size() != 2 * 3 - 1 && text.size() != 8 * 3 - 1) return std::nullopt;
    std::uint64_t value = 0;
    for (std::size_t at = 0; at < text.size(); at += 3) {
        if (at > 0 && text[at - 1] != separator) return std::nullopt;
        const auto byte = parse_number(text.substr(at, 2), 16);
        if (!byte) return std::nullopt;
        value = value << 8 | *byte;
    }
    return value;
}

std::optional<std::uint64_t> parse(std::string_view text) {
    if (text.starts_with("0x") || text.starts_with("0X")) return parse_number(text.substr(2), 16);
    if (text.size() > 2 && (text[2] == ':' || text[2] == '-')) return parse_bytes(text, text[2]);
    return parse_number(text, 10);
}

} // namespace

std::optional<Address> parse_address(std::string_view text) {
    const auto value = parse(text);
    return value ? std::optional{address(*value)} : std::nullopt;
}

std::string to_text(Address address) {
    return number(address) < 256 ? fmt::format("{}", number(address)) : fmt::format("0x{:x}", number(address));
}

} // namespace locus::config
