// Is it text, and in which lines?
#pragma once

#include "drivers/wire/bytes.h"

#include <cstddef>
#include <string>
#include <vector>

namespace locus::sniff {

/// Nearly all of it printable ASCII or white space. False for nothing.
bool is_text(wire::Bytes bytes);

struct TextLines {
    std::size_t lines = 0;          ///< whole ones
    std::size_t longest = 0;        ///< characters
    std::vector<std::string> first; ///< some of them, shortened, other than printable characters as dots
};

TextLines lines_of(wire::Bytes bytes);

} // namespace locus::sniff
