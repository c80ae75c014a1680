// A classic CAN frame as an encoder gives it, and the bit fields of its payload in DBC's Intel order.
#pragma once

#include "drivers/packet.h"

#include <array>
#include <cstdint>
#include <span>

namespace locus {

struct CanFrame {
    std::uint32_t id = 0; ///< as in linux/can.h
    std::uint8_t length = 0;
    std::array<std::uint8_t, 8> data{};

    /// As if received at `time`; valid as long as the frame.
    Packet packet(Timestamp time) const {
        Packet packet;
        packet.wire = Wire::can;
        packet.time = time;
        packet.can_id = id;
        packet.data = {data.data(), length};
        return packet;
    }
};

/// A payload of up to 8 bytes as one number, byte 0 lowest; bytes beyond the eighth are not looked at.
constexpr std::uint64_t can_word(std::span<const std::uint8_t> data) {
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < data.size() && i < 8; ++i) word |= std::uint64_t{data[i]} << (8 * i);
    return word;
}

/// One signal of a DBC file, `start|length@1`: bits counted from the lowest of byte 0.
struct CanSignal {
    unsigned start;
    unsigned length; ///< less than 64

    constexpr std::uint64_t mask() const { return (std::uint64_t{1} << length) - 1; }
    constexpr std::uint64_t read(std::uint64_t word) const { return word >> start & mask(); }
    constexpr std::int64_t read_signed(std::uint64_t word) const {
        const std::uint64_t sign = std::uint64_t{1} << (length - 1);
        return static_cast<std::int64_t>(read(word) ^ sign) - static_cast<std::int64_t>(sign);
    }
    /// The bits to set; a value too large loses its upper bits.
    constexpr std::uint64_t write(std::uint64_t value) const { return (value & mask()) << start; }
};

} // namespace locus
