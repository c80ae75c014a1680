// READING of docs/protocol.md.
#pragma once

#include "daemon/output.h"
#include "daemon/socket/names.h"

#include <string>

namespace locus {

/// The READING object without its closing '}', so that a client's own `dropped` can follow.
std::string open_reading_line(const ReadingItem& reading, const Names& names);

} // namespace locus
