// The baud rate of a line that only talks: each usual one is listened to for a while.
#pragma once

#include "tools/sniff/contest.h"

#include <functional>
#include <optional>
#include <vector>

namespace locus::sniff {

/// In the order of how often devices come with them.
inline constexpr std::array usual_baud_rates{115200, 9600,    921600, 460800, 230400, 57600,   38400,
                                             19200,  1000000, 500000, 4800,   250000, 1500000, 2000000};

struct BaudRate {
    int baud_bd = 0;
    std::vector<Standing> winners; ///< known formats at this rate; empty: it only has the most structure
};

/// `listen` gives what comes at a rate, or nothing when it must not go on (the port is gone, somebody pressed Ctrl-C).
/// Ends at the first rate with a format that is sure. Empty when no rate gives anything but noise.
std::optional<BaudRate> find_baud_rate(const std::function<std::optional<Capture>(int baud_bd)>& listen);

} // namespace locus::sniff
