// The 29-bit identifier of a J1939 frame: who says what to whom.
#pragma once

#include <linux/can.h>

#include <cstdint>
#include <optional>

namespace locus::j1939 {

inline constexpr std::uint8_t everyone = 0xFF;

struct Identifier {
    std::uint8_t priority = 6; ///< 0 is the most urgent, 7 the least
    std::uint32_t group = 0;   ///< parameter group number; its low byte is 0 where there is a destination
    std::uint8_t source = 0;
    std::uint8_t destination = everyone; ///< in groups below 0xF000 (of each page); the others go to everyone

    bool operator==(const Identifier&) const = default;
};

constexpr bool has_destination(std::uint32_t group) { return (group >> 8 & 0xFF) < 240; }

/// Of a CAN id as in linux/can.h; empty when it is a standard id, a remote or an error frame.
constexpr std::optional<Identifier> identifier(std::uint32_t can_id) {
    if ((can_id & (CAN_EFF_FLAG | CAN_RTR_FLAG | CAN_ERR_FLAG)) != CAN_EFF_FLAG) return std::nullopt;
    Identifier id;
    id.priority = static_cast<std::uint8_t>(can_id >> 26 & 7);
    id.group = can_id >> 8 & 0x3FFFF;
    id.source = static_cast<std::uint8_t>(can_id);
    if (has_destination(id.group)) {
        id.destination = static_cast<std::uint8_t>(id.group);
        id.group &= ~0xFFu;
    }
    return id;
}

constexpr std::uint32_t can_id(const Identifier& id) {
    const std::uint32_t group = has_destination(id.group) ? (id.group & ~0xFFu) | id.destination : id.group;
    return CAN_EFF_FLAG | (id.priority & 7u) << 26 | (group & 0x3FFFF) << 8 | id.source;
}

} // namespace locus::j1939
