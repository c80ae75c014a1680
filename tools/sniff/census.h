// Who is on a CAN bus: every identifier, how often, how long, and which of its bytes change.
#pragma once

#include "tools/sniff/capture.h"

#include <cstdint>
#include <string>
#include <vector>

namespace locus::sniff {

struct Census {
    std::uint32_t can_id = 0; ///< as in linux/can.h
    std::size_t frames = 0;
    double rate_hz = 0; ///< 0: not known
    std::size_t shortest = 0, longest = 0;
    std::vector<std::vector<std::uint8_t>> samples; ///< some payloads, in order
};

/// By identifier; at most 512 of them.
std::vector<Census> census(const Capture& capture);

/// What kind of bus it looks like, a sentence each.
std::vector<std::string> looks_like(const std::vector<Census>& ids);

/// "340", "18FF1234": as candump writes it.
std::string id_text(std::uint32_t can_id);

} // namespace locus::sniff
