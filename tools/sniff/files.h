// Files in place of a device: raw bytes, and which inputs a recording holds.
#pragma once

#include "drivers/transport/transport.h"

#include <memory>
#include <optional>
#include <string>

namespace locus::sniff {

/// A file of nothing but the bytes of a line, as `cat /dev/ttyUSB0 > file` makes it. It ends, and it knows no times.
std::unique_ptr<Transport> raw_file(const std::string& path);

/// The input of a recording whose lines are wanted: `wanted`, or the only one there is. Else a sentence with the names.
std::optional<std::string> recorded_input(const std::string& path, const std::string& wanted, std::string& error);

} // namespace locus::sniff
