// The walk of ultrax_dw1000_raw: two-way exchanges of a tag with six anchors as raw DW1000 stamps, one a line:
// "TH,TL,#,a,tempvbat,T1H,...,T4L", hexadecimal. Its README calls T3 and T4 the answer's; by the numbers T1 and T2 are
// the tag's (question sent, answer heard), T3 and T4 the anchor's (answer sent, question heard). Zeros: nobody
// answered.
#pragma once

#include "fusion/uwb/two_way.h"
#include "tests/replay/data.h"

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace locus::ultrax {

struct Row {
    double time_s = 0;
    unsigned sequence = 0;
    unsigned anchor = 0;
    uwb::SingleSided exchange;

    bool answered() const {
        return exchange.answer_rx_ticks_in_a != 0 && exchange.answer_tx_ticks_in_b != 0 &&
               exchange.poll_rx_ticks_in_b != 0;
    }
};

/// Empty when the line has not thirteen hexadecimal numbers.
inline std::optional<Row> read_row(std::string line) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    std::array<std::uint64_t, 13> n{};
    for (auto& number : n)
        if (!(words >> std::hex >> number)) return std::nullopt;
    const auto stamp = [&](std::size_t high) { return n[high] << 32 | n[high + 1]; };
    return Row{static_cast<double>(stamp(0)) * 1e-6, static_cast<unsigned>(n[2]), static_cast<unsigned>(n[3]),
               uwb::SingleSided{stamp(5), stamp(11), stamp(9), stamp(7)}};
}

struct Walk {
    std::map<unsigned, std::vector<Row>> answered; ///< by anchor
    std::size_t rows = 0, unanswered = 0, unreadable = 0;
};

inline Walk read_walk(const std::filesystem::path& csv) {
    std::ifstream file(csv);
    std::string line;
    std::getline(file, line); // titles
    Walk walk;
    while (std::getline(file, line)) {
        ++walk.rows;
        const auto row = read_row(line);
        if (!row)
            ++walk.unreadable;
        else if (!row->answered())
            ++walk.unanswered;
        else
            walk.answered[row->anchor].push_back(*row);
    }
    return walk;
}

} // namespace locus::ultrax
