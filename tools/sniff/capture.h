// What came over one wire, kept in the order that it came so that many decoders can be tried on it. Bounded: whatever
// comes after the limits is left out.
#pragma once

#include "drivers/transport/transport.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace locus::sniff {

class Capture : public PacketSink {
  public:
    static constexpr std::size_t most_bytes = 1 << 20;
    static constexpr std::size_t most_packets = 1 << 16;

    /// Packets of another wire than the first one's are left out.
    void packet(const Packet& packet) override;

    bool empty() const { return packets_.empty(); }
    bool full() const { return bytes_.size() >= most_bytes || packets_.size() >= most_packets; }
    Wire wire() const { return packets_.empty() ? Wire::bytes : packets_.front().packet.wire; }
    std::size_t packets() const { return packets_.size(); }
    /// Valid as long as nothing more is kept.
    Packet at(std::size_t index) const;
    /// Of all packets, one after the other.
    std::span<const std::uint8_t> bytes() const { return bytes_; }
    /// From the first packet to the last.
    Duration duration() const;
    /// The same packets with other data; `bytes` has as many as bytes().
    Capture with_bytes(std::vector<std::uint8_t> bytes) const;

  private:
    struct Kept {
        Packet packet; ///< its data is in bytes_
        std::size_t begin, size;
    };
    std::vector<Kept> packets_;
    std::vector<std::uint8_t> bytes_;
};

} // namespace locus::sniff
