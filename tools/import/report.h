// What an import found, for people and as one JSON object.
#pragma once

#include "tools/import/source.h"

#include <string>
#include <vector>

namespace locus::importing {

std::uint64_t measurements(const std::vector<FileReport>& reports);
std::vector<std::string> report_lines(const std::vector<FileReport>& reports);
std::string report_json(const std::vector<FileReport>& reports, const std::string& output);

} // namespace locus::importing
