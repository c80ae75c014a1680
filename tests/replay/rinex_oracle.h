// Debian's rtklib as a second opinion: what its convbin makes of a UBX log, as the numbers of its RINEX navigation
// file.
#pragma once

#include "tests/support/temporary_folder.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace locus::test {

/// A number as it is printed with 12 digits after a leading 0.
struct Printed {
    double value = 0;
    double unit = 0; ///< of the last digit

    bool is(double other) const { return std::abs(other - value) <= 0.51 * unit; }
};

using Records = std::map<std::string, std::vector<Printed>>; ///< by satellite, the last one of each

inline bool convbin_installed() { return std::system("command -v convbin >/dev/null 2>&1") == 0; }

inline Printed printed(std::string field) {
    const std::size_t d = field.find('D');
    if (d == std::string::npos) return {};
    field[d] = 'E';
    return {std::stod(field), std::pow(10.0, std::stoi(field.substr(d + 1)) - 12)};
}

/// Four fields of 19 characters behind 4 of indentation, the first line of a record has three behind 23.
inline Records read_rinex_navigation(const std::string& path) {
    Records records;
    std::ifstream file(path);
    std::string line, satellite;
    while (std::getline(file, line) && line.find("END OF HEADER") == std::string::npos) {
    }
    while (std::getline(file, line)) {
        const bool first = line[0] != ' ';
        if (first) records[satellite = line.substr(0, 3)].clear();
        for (std::size_t at = first ? 23 : 4; at + 19 <= line.size(); at += 19)
            records[satellite].push_back(printed(line.substr(at, 19)));
    }
    return records;
}

inline Records convbin(const std::vector<std::uint8_t>& ubx) {
    const TemporaryFolder folder;
    std::ofstream(folder / "log.ubx", std::ios::binary)
        .write(reinterpret_cast<const char*>(ubx.data()), static_cast<std::streamsize>(ubx.size()));
    const std::string command = "convbin -r ubx -v 3.04 -n " + folder / "nav" + " -o " + folder / "obs" + " " +
                                folder / "log.ubx" + " >/dev/null 2>&1";
    if (std::system(command.c_str()) != 0) return {};
    return read_rinex_navigation(folder / "nav");
}

} // namespace locus::test
