#include "drivers/transport/can_batch.h"

#include "drivers/transport/can_frame.h"

namespace locus {

int CanBatch::receive(int fd) {
    for (std::size_t i = 0; i < size; ++i) { // all of it each time: the kernel writes into these
        vectors_[i] = {&frames_[i], sizeof frames_[i]};
        messages_[i] = {};
        messages_[i].msg_hdr.msg_iov = &vectors_[i];
        messages_[i].msg_hdr.msg_iovlen = 1;
        messages_[i].msg_hdr.msg_control = controls_[i].data();
        messages_[i].msg_hdr.msg_controllen = controls_[i].size();
    }
    return ::recvmmsg(fd, messages_.data(), size, MSG_DONTWAIT, nullptr);
}

std::optional<Packet> CanBatch::packet(std::size_t i) const {
    return packet_from_can(frames_[i], messages_[i].msg_len);
}

} // namespace locus
