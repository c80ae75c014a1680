// Between a Packet and the frames that a CAN_RAW socket reads and writes (protocols.md 6.1). Pure, so that it is tested
// where the kernel has no CAN.
#pragma once

#include "drivers/packet.h"

#include <linux/can.h>

#include <cstddef>
#include <optional>

namespace locus {

/// One frame as read: `size` bytes were received into it, which tells classic (16) from FD (72). The packet's data lie
/// in `frame`; a remote frame has none. Empty when size or length make no sense.
std::optional<Packet> packet_from_can(const canfd_frame& frame, std::size_t size);

struct CanToSend {
    canfd_frame frame{};
    std::size_t size = 0; ///< how much of it is written: CAN_MTU or CANFD_MTU
};

/// Empty when there are more than 8 (FD: 64) bytes. FD lengths that the wire does not know are filled up with zeros.
std::optional<CanToSend> can_from_packet(const Packet& packet);

} // namespace locus
