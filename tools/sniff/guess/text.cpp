#include "tools/sniff/guess/text.h"

#include <algorithm>
#include <string_view>

namespace locus::sniff {
namespace {

constexpr std::size_t lines_shown = 5, characters_shown = 100;

bool is_printable(std::uint8_t byte) { return byte >= ' ' && byte < 0x7F; }
bool is_of_text(std::uint8_t byte) { return is_printable(byte) || byte == '\r' || byte == '\n' || byte == '\t'; }

std::string shown(std::string_view line) {
    std::string text{line.substr(0, characters_shown)};
    std::ranges::replace_if(text, [](char c) { return !is_printable(static_cast<std::uint8_t>(c)); }, '.');
    return text;
}

} // namespace

bool is_text(wire::Bytes bytes) {
    const auto good = static_cast<std::size_t>(std::ranges::count_if(bytes, is_of_text));
    return !bytes.empty() && good * 100 >= bytes.size() * 97;
}

TextLines lines_of(wire::Bytes bytes) {
    TextLines found;
    std::string_view rest{reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
        std::string_view line = rest.substr(0, end);
        rest.remove_prefix(end + 1);
        if (line.ends_with('\r')) line.remove_suffix(1);
        if (line.empty()) continue;
        ++found.lines;
        found.longest = std::max(found.longest, line.size());
        // The first one is often the tail of a line.
        if (found.lines > 1 && found.first.size() < lines_shown) found.first.push_back(shown(line));
    }
    return found;
}

} // namespace locus::sniff
