#include "daemon/socket/json_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace locus {
namespace {

constexpr int length_decimals = 6; // micrometres

void append_number(std::string& out, double value, std::chars_format format, int precision) {
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, value, format, precision).ptr;
    out.append(text, end);
}

} // namespace

void append_fixed(std::string& out, double value, int decimals) {
    if (std::abs(value) >= 1e9) return append_general(out, value);
    append_number(out, value, std::chars_format::fixed, decimals);
}

void append_general(std::string& out, double value) { append_number(out, value, std::chars_format::general, 9); }

void append_text(std::string& out, std::string_view text) {
    out += nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void append_vector(std::string& out, std::string_view key, std::span<const double> values) {
    if (!all_finite(values)) return;
    out += ",\"";
    out += key;
    out += "\":";
    char mark = '[';
    for (const double value : values) {
        out += mark;
        append_fixed(out, value, length_decimals);
        mark = ',';
    }
    out += ']';
}

bool all_finite(std::span<const double> values) {
    return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

} // namespace locus
