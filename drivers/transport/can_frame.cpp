#include "drivers/transport/can_frame.h"

#include <algorithm>
#include <array>

namespace locus {
namespace {

constexpr std::array<std::uint8_t, 7> long_fd_lengths{12, 16, 20, 24, 32, 48, 64};

std::uint8_t fd_length(std::size_t bytes) {
    if (bytes <= CAN_MAX_DLEN) return static_cast<std::uint8_t>(bytes);
    return *std::lower_bound(long_fd_lengths.begin(), long_fd_lengths.end(), bytes);
}

} // namespace

std::optional<Packet> packet_from_can(const canfd_frame& frame, std::size_t size) {
    const bool fd = size == CANFD_MTU;
    if ((!fd && size != CAN_MTU) || frame.len > (fd ? CANFD_MAX_DLEN : CAN_MAX_DLEN)) return std::nullopt;
    Packet packet;
    packet.wire = Wire::can;
    packet.can_id = frame.can_id;
    packet.can_fd = fd;
    if (fd) packet.can_fd_flags = frame.flags & (CANFD_BRS | CANFD_ESI);
    const bool remote = frame.can_id & CAN_RTR_FLAG;
    packet.data = {frame.data, remote ? std::size_t{0} : frame.len};
    return packet;
}

std::optional<CanToSend> can_from_packet(const Packet& packet) {
    if (packet.data.size() > (packet.can_fd ? CANFD_MAX_DLEN : CAN_MAX_DLEN)) return std::nullopt;
    CanToSend out;
    out.size = packet.can_fd ? CANFD_MTU : CAN_MTU;
    out.frame.can_id = packet.can_id;
    out.frame.len = fd_length(packet.data.size());
    if (packet.can_fd) out.frame.flags = packet.can_fd_flags;
    std::copy(packet.data.begin(), packet.data.end(), out.frame.data);
    return out;
}

} // namespace locus
