// The head of an IEEE 802.15.4 frame (2003 and 2006): who sent it to whom, with short or long addresses. What a sniffer
// needs to know of other people's packets (ZigBee, Thread, 6LoWPAN), whatever they carry.
#pragma once

#include "drivers/wire/bytes.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace locus::radio {

struct MacHeader {
    struct Node {
        std::uint16_t pan = 0;
        std::uint64_t address = 0;
        bool is_long = false; ///< an EUI-64, else 16 bits
        bool operator==(const Node&) const = default;
    };

    std::uint8_t type = 0; ///< 0 beacon, 1 data, 2 acknowledgement, 3 command
    std::uint8_t sequence = 0;
    std::optional<Node> destination{};
    std::optional<Node> source{};
    bool operator==(const MacHeader&) const = default;
};

/// `frame` from its frame control field on. Empty when it is shorter than its own head says, or of a version or an
/// addressing that was not there in 2006.
std::optional<MacHeader> parse_mac_header(wire::Bytes frame);
/// The PAN of the source is left out where it is the destination's.
std::vector<std::uint8_t> encode(const MacHeader& header);

} // namespace locus::radio
