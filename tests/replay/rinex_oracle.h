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

    /// Writers make decimals with errors of their own, in the last digit but one behind it.
    bool is(double other) const { return std::abs(other - value) <= 0.56 * unit; }
};

using Records = std::map<std::string, std::vector<Printed>>; ///< by satellite, the last one of each

inline bool convbin_installed() { return std::system("command -v convbin >/dev/null 2>&1") == 0; }

inline Printed printed(std::string field) {
    const std::size_t d = field.find('D');
    if (d == std::string::npos) return {};
    field[d] = 'E';
    return {std::stod(field), std::pow(10.0, std::stoi(field.substr(d + 1)) - 12)};
}

struct Record {
    std::string satellite; ///< G05; version 2 does not say the letter
    std::vector<Printed> numbers;
};

/// Fields of 19 characters, four behind 4 of indentation, three behind 23 in a record's first line; in version 2 it is
/// one less.
inline std::vector<Record> read_rinex_records(const std::string& path) {
    std::vector<Record> records;
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    const std::size_t less = line.find('2') < 6 ? 1 : 0; // of "     2.11" and "     2"; version 3.02 has its 2 later
    while (std::getline(file, line) && line.find("END OF HEADER") == std::string::npos) {
    }
    while (std::getline(file, line)) {
        const bool first = line.find_first_not_of(' ') < 3 - less;
        if (first) records.push_back({line.substr(0, 3 - less), {}});
        for (std::size_t at = (first ? 23 : 4) - less; at + 19 <= line.size(); at += 19)
            records.back().numbers.push_back(printed(line.substr(at, 19)));
    }
    return records;
}

inline Records read_rinex_navigation(const std::string& path) {
    Records records;
    for (auto& record : read_rinex_records(path)) records[record.satellite] = std::move(record.numbers);
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
