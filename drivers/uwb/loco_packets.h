// Packets that Bitcraze's Loco positioning anchors send each other and all who listen (protocols.md 1(d)). Stamps are
// the low 32 bits of a DW1000's clock; distances are in its ticks and hold the delay of the antennas as well. Lists
// stand in the packet they were read from.
#pragma once

#include "drivers/wire/bytes.h"

#include <array>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

namespace locus::uwb::loco {

inline constexpr std::size_t anchors_of_tdoa2 = 8, most_remotes = 16;

/// From each of eight anchors in its slot: when it sent this and when it received the others' last packets.
struct Tdoa2 {
    std::array<std::uint8_t, anchors_of_tdoa2> packets{}; ///< number of each anchor's last packet; of its own: this one
    std::array<std::uint32_t, anchors_of_tdoa2> ticks_in_sender{};
    std::array<std::uint16_t, anchors_of_tdoa2> distance_ticks{}; ///< 0: not known
    bool operator==(const Tdoa2&) const = default;
};

/// From any number of anchors at random times: when it sent this and when it received some of the others' packets.
struct Tdoa3 {
    struct Remote {
        std::uint8_t anchor = 0;
        std::uint8_t packet = 0; ///< 7 bits
        std::uint32_t rx_ticks_in_sender = 0;
        std::uint16_t distance_ticks = 0; ///< 0: not known
        bool operator==(const Remote&) const = default;
    };
    std::uint8_t packet = 0; ///< 7 bits
    std::uint32_t tx_ticks_in_sender = 0;
    std::array<Remote, most_remotes> remotes{};
    std::size_t remote_count = 0;
    bool operator==(const Tdoa3&) const = default;
};

/// Two-way ranging between an anchor and a tag: whoever listens in cannot tell a range or a difference from it.
struct TwoWay {
    std::uint8_t type = 1; ///< 1 poll, 2 answer, 3 final, 4 report
    bool operator==(const TwoWay&) const = default;
};

using Payload = std::variant<Tdoa2, Tdoa3, TwoWay>;

/// Empty: of another type, or shorter than it says. What follows (an LPP packet) is not looked at.
std::optional<Payload> parse(wire::Bytes payload);

std::vector<std::uint8_t> encode(const Tdoa2& packet);
std::vector<std::uint8_t> encode(const Tdoa3& packet);

} // namespace locus::uwb::loco
