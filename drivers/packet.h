// Packet: what a transport hands to a decoder. Bytes of a stream, or one CAN frame.
#pragma once

#include "fusion/time.h"

#include <cstdint>
#include <span>

namespace locus {

enum class Wire : std::uint8_t { bytes, can };

struct Packet {
    Wire wire = Wire::bytes;
    /// When the last byte (of the chunk, or of the frame) was received: kernel or hardware stamp where there is one.
    Timestamp time{};
    /// Time that one byte takes on the wire; zero when not known. A frame that ends n bytes before the end of the
    /// chunk was complete n * byte_time earlier.
    Duration byte_time{};
    std::uint32_t can_id = 0; ///< as in linux/can.h: EFF, RTR and ERR flags in the top bits
    std::uint8_t can_fd_flags = 0;
    bool can_fd = false;
    std::span<const std::uint8_t> data; ///< valid during the call only
};

} // namespace locus
