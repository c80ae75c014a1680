// Where a frame of a described layout begins and ends, and whether it is intact: what FrameStream asks.
#pragma once

#include "drivers/layout/serial_layout.h"
#include "drivers/wire/bytes.h"
#include "drivers/wire/frame_stream.h"

namespace locus::layout {

class SerialFormat {
  public:
    static constexpr std::size_t max_length = longest_serial_frame;

    explicit SerialFormat(const SerialLayoutSettings& settings);

    Look look(wire::Bytes bytes) const;
    /// Writes length, tail and checksum into a frame that is else complete.
    void seal(std::vector<std::uint8_t>& frame) const;
    /// Shorter, and it cannot hold what the settings say.
    std::size_t shortest() const { return shortest_; }

  private:
    bool is_intact(wire::Bytes frame) const;
    std::uint64_t checksum(wire::Bytes frame) const;
    std::size_t checksum_at(std::size_t frame_bytes) const {
        return frame_bytes - checksum_bytes_ - static_cast<std::size_t>(settings_.checksum_trailer_bytes);
    }

    SerialLayoutSettings settings_;
    std::vector<std::uint8_t> sync_, tail_;
    std::size_t checksum_bytes_;
    std::size_t shortest_;
};

/// "AA 25 01" as bytes; empty optional when it is no hex or longer than 16 bytes.
std::optional<std::vector<std::uint8_t>> bytes_of_hex(std::string_view text);

} // namespace locus::layout
