#include "config/parse_plain.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>

namespace locus::config {
namespace {

template <class Number, class... Base>
std::optional<Number> parse_all(std::string_view text, Base... base) {
    if (text.starts_with('+')) text.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.begin(), text.end(), value, base...);
    if (error != std::errc{} || end != text.end()) return std::nullopt;
    return value;
}

bool is_one_of(std::string_view text, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), text) != words.end();
}

} // namespace

std::optional<bool> parse_bool(std::string_view text) {
    if (is_one_of(text, {"true", "True", "TRUE", "yes", "Yes", "YES", "on", "On", "ON"})) return true;
    if (is_one_of(text, {"false", "False", "FALSE", "no", "No", "NO", "off", "Off", "OFF"})) return false;
    return std::nullopt;
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
    const bool hexadecimal = text.starts_with("0x") || text.starts_with("0X");
    if (hexadecimal)
        return text.substr(2).starts_with('-') ? std::nullopt : parse_all<std::int64_t>(text.substr(2), 16);
    return parse_all<std::int64_t>(text);
}

std::optional<double> parse_double(std::string_view text) {
    const auto value = parse_all<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

} // namespace locus::config
