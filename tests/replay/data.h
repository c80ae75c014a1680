// Where the recordings are: nothing of them is copied into the project, and tests skip where they are not.
#pragma once

#include "tests/support/source_folder.h"

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace locus::test {

/// A file or folder of LOCUS_DATA or ../shared/data, if it is there.
inline std::optional<std::filesystem::path> recorded(const std::string& name) {
    const char* named = std::getenv("LOCUS_DATA");
    const auto data =
        named ? std::filesystem::path(named) : std::filesystem::path(test::source_folder()) / "../shared/data";
    const auto found = data / name;
    return std::filesystem::exists(found) ? std::optional(found) : std::nullopt;
}

inline std::vector<std::uint8_t> bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace locus::test
