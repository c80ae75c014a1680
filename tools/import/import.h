// Files of GNSS receivers, navigation services and SLAMs into one recording, in order of time.
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
    slam::TumSettings poses{}; ///< of TUM poses; the tag is the one above
    double poses_shift_s = 0;  ///< from their clock to that of the other files
};

/// Writes the recording. A measurement's input is the place of its file in the request. Throws std::runtime_error with
/// a sentence when a file cannot be read or is of no kind that is known, or the recording cannot be written.
std::vector<FileReport> import_files(const Request& request);

} // namespace locus::importing
