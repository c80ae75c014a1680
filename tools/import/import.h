// Files of GNSS receivers and navigation services into one recording, in order of time.
#pragma once

#include "tools/import/source.h"

#include <string>
#include <vector>

namespace locus::importing {

struct Request {
    std::vector<std::string> files;
    std::string output; ///< .jsonl
    Address tag = address(0);
    bool overwrite = false;
};

/// Writes the recording. A measurement's input is the place of its file in the request. Throws std::runtime_error with
/// a sentence when a file cannot be read or is of no kind that is known, or the recording cannot be written.
std::vector<FileReport> import_files(const Request& request);

} // namespace locus::importing
