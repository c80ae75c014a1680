// Is a file text at all? Asked before the parser sees it: a settings file is UTF-8 without control characters, so
// every name in it can go into JSON, a log or a terminal as it is.
#pragma once

#include "config/problems.h"

#include <string>
#include <string_view>

namespace locus::config {

/// False, with a problem that says where, when the text is too long, not UTF-8 or holds control characters.
bool is_plain_text(std::string_view text, Problems& problems);

/// Bytes of the UTF-8 character that `text` begins with; 0 when that is none (RFC 3629 sec. 4).
std::size_t utf8_length(std::string_view text);

/// No control characters: text that came out of YAML may hold them by way of escapes.
bool is_printable(std::string_view text);

/// For messages: at most 40 bytes of it, on one line.
std::string shown(std::string_view text);

} // namespace locus::config
