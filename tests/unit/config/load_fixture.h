// Loads a text and shows its problems as lines, for tests to compare.
#pragma once

#include "config/load.h"

#include <string>
#include <string_view>
#include <vector>

namespace locus {

/// "line:column: message" of each problem; "message" where it is of the file as a whole.
inline std::vector<std::string> problems_of(std::string_view yaml) {
    std::vector<std::string> lines;
    for (const auto& problem : load_settings_text(yaml, "f").problems)
        lines.push_back(to_string(problem).substr(std::string_view(problem.line == 0 ? "f: " : "f:").size()));
    return lines;
}

/// The only problem of the text, or all of them so that a failed comparison shows them.
inline std::string problem_of(std::string_view yaml) {
    std::string all;
    for (const auto& line : problems_of(yaml)) all += (all.empty() ? "" : "\n") + line;
    return all;
}

inline constexpr std::string_view hall = R"(
site:
  name: hall
  origin: {latitude_deg: 48.1, longitude_deg: 11.6}
  anchors:
    - {name: A0, address: 0, position_site_m: [0, 0, 2.5]}
    - {name: A1, address: 0x1234, position_site_m: [10, 0, 2.5], sigma_m: 0.05}
    - {name: A2, address: "DE:CA:01:02:03:04:05:06", position_site_m: [10, -8.5, 2.5], range_bias_m: -0.2}
targets:
  - {name: forklift-7, address: 7}
inputs:
  - name: trek
    transport: serial
    path: /dev/serial/by-id/usb-trek
    baud_bd: 9600
    decoder: trek1000
    tag_offset: 16
    delay_s: 0.002
fusion: {rate_hz: 50, accept_unknown_targets: no}
publish:
  # max_clients: 4
log: {level: debug}
)";

} // namespace locus
