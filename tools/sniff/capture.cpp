#include "tools/sniff/capture.h"

#include <utility>

namespace locus::sniff {

void Capture::packet(const Packet& packet) {
    if (full() || (!empty() && packet.wire != wire())) return;
    packets_.push_back({packet, bytes_.size(), packet.data.size()});
    packets_.back().packet.data = {};
    bytes_.insert(bytes_.end(), packet.data.begin(), packet.data.end());
}

Packet Capture::at(std::size_t index) const {
    const Kept& kept = packets_[index];
    Packet packet = kept.packet;
    packet.data = std::span{bytes_}.subspan(kept.begin, kept.size);
    return packet;
}

Duration Capture::duration() const {
    return empty() ? Duration{} : packets_.back().packet.time - packets_.front().packet.time;
}

Capture Capture::with_bytes(std::vector<std::uint8_t> bytes) const {
    Capture other = *this;
    other.bytes_ = std::move(bytes);
    return other;
}

} // namespace locus::sniff
