// Room for many CAN frames fetched with one system call (recvmmsg), each with what the kernel says of it.
#pragma once

#include "drivers/packet.h"
#include "drivers/transport/receive_stamps.h"

#include <linux/can.h>
#include <sys/socket.h>

#include <array>
#include <cstddef>
#include <optional>

namespace locus {

class CanBatch {
  public:
    /// Never blocks. Returns the number of frames, or -1 with errno.
    int receive(int fd);
    /// The data lie in the batch. Empty when the frame makes no sense.
    std::optional<Packet> packet(std::size_t i) const;
    ControlData control(std::size_t i) const { return read_control(messages_[i].msg_hdr); }

  private:
    static constexpr std::size_t size = 32; // 1 Mbit/s brings at most 8 frames a millisecond

    struct alignas(cmsghdr) Control : std::array<std::byte, 256> {};

    std::array<canfd_frame, size> frames_{};
    std::array<Control, size> controls_{};
    std::array<iovec, size> vectors_{};
    std::array<mmsghdr, size> messages_{};
};

} // namespace locus
