#include "config/plain_text.h"
#include "config/yaml_tree.h"

#include <fmt/format.h>

#include <algorithm>

namespace locus::config {
namespace {

bool control(char c) { return (c >= 0 && c < 0x20) || c == 0x7f; }
bool blank(char c) { return c == '\n' || c == '\r' || c == '\t'; }
unsigned byte_at(std::string_view text, std::size_t at) { return static_cast<unsigned char>(text[at]); }

Mark mark_of(std::string_view text, std::size_t at) {
    const auto before = text.substr(0, at);
    const auto line_start = before.rfind('\n') + 1; // npos + 1 is 0
    return {1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
            1 + static_cast<int>(at - line_start)};
}

/// Lead byte -> length, and the limits of the second byte that shut out overlong forms, surrogates and > U+10FFFF.
struct Lead {
    unsigned first, last;
    std::size_t length;
    unsigned second_minimum, second_maximum;
};
constexpr Lead leads[] = {
    {0x00, 0x7F, 1, 0, 0},       {0xC2, 0xDF, 2, 0x80, 0xBF}, {0xE0, 0xE0, 3, 0xA0, 0xBF},
    {0xE1, 0xEC, 3, 0x80, 0xBF}, {0xED, 0xED, 3, 0x80, 0x9F}, {0xEE, 0xEF, 3, 0x80, 0xBF},
    {0xF0, 0xF0, 4, 0x90, 0xBF}, {0xF1, 0xF3, 4, 0x80, 0xBF}, {0xF4, 0xF4, 4, 0x80, 0x8F},
};

} // namespace

std::size_t utf8_length(std::string_view text) {
    if (text.empty()) return 0;
    const auto lead = std::find_if(std::begin(leads), std::end(leads), [&](const Lead& l) {
        return byte_at(text, 0) >= l.first && byte_at(text, 0) <= l.last;
    });
    if (lead == std::end(leads) || lead->length > text.size()) return 0;
    if (lead->length > 1 && (byte_at(text, 1) < lead->second_minimum || byte_at(text, 1) > lead->second_maximum))
        return 0;
    for (std::size_t i = 2; i < lead->length; ++i)
        if ((byte_at(text, i) & 0xC0) != 0x80) return 0;
    return lead->length;
}

bool is_plain_text(std::string_view text, Problems& problems) {
    if (text.size() > max_file_bytes) {
        problems.add({}, fmt::format("the file is longer than {} bytes", max_file_bytes));
        return false;
    }
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = utf8_length(text.substr(at));
        if (length == 0 || (control(text[at]) && !blank(text[at]))) {
            problems.add(mark_of(text, at), "this is not plain UTF-8 text; save the file as UTF-8 and take out "
                                            "characters that do not print");
            return false;
        }
        at += length;
    }
    return true;
}

/// An escape can bring in what the file could not hold: yaml-cpp makes a lone byte 0x85 of "\\N".
bool is_printable(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = utf8_length(text.substr(at));
        if (length == 0 || control(text[at])) return false;
        at += length;
    }
    return true;
}

std::string shown(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::size_t end = 0;
    for (std::size_t n = utf8_length(text); n > 0 && end + n <= longest; n = utf8_length(text.substr(end))) end += n;
    std::string line(text.substr(0, end));
    std::replace_if(line.begin(), line.end(), control, ' ');
    return end < text.size() ? line + "..." : line;
}

} // namespace locus::config
