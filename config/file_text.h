// A settings file from the disk into memory, with an error that names the user who may not read it.
#pragma once

#include <optional>
#include <string>

namespace locus::config {

/// At most one byte more than max_file_bytes is read, so a file without end ends. Empty with a sentence in `error`.
std::optional<std::string> read_file(const std::string& path, std::string& error);

} // namespace locus::config
