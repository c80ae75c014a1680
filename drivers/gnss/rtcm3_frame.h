// The frame of RTCM 3 (RTCM 10403, chapter 4): D3, six bits that are 0, ten bits of length, the message, CRC-24Q over
// all before it. Fields of messages lie bit by bit, highest bit first. D3 also stands inside messages, so only the
// length and the checksum say what a frame is.
#pragma once

#include "drivers/wire/checksum.h"
#include "drivers/wire/frame_stream.h"

#include <vector>

namespace locus::gnss::rtcm3 {

inline constexpr std::uint8_t sync = 0xD3;
inline constexpr std::size_t head_length = 3, checksum_length = 3, longest_message = 1023;

struct Format {
    static constexpr std::size_t max_length = head_length + longest_message + checksum_length;

    Look look(wire::Bytes bytes) const {
        const bool begins = bytes[0] == sync && (bytes.size() < 2 || bytes[1] <= longest_message >> 8);
        if (!begins) return Look::none(Refusal::garbage);
        if (bytes.size() < head_length) return Look::need(head_length);
        const std::size_t length = head_length + wire::big<std::uint16_t>(bytes, 1) + checksum_length;
        if (bytes.size() < length) return Look::need(length);
        const std::size_t checked = length - checksum_length;
        const bool good = wire::crc24q(bytes.first(checked)) == wire::big_bytes(bytes, checked, checksum_length);
        return good ? Look::frame(length) : Look::none(Refusal::bad_checksum);
    }
};

/// Of an intact frame.
inline wire::Bytes message_of(wire::Bytes frame) {
    return frame.subspan(head_length, frame.size() - head_length - checksum_length);
}

/// A whole frame around a message of at most 1023 bytes.
inline std::vector<std::uint8_t> frame(wire::Bytes message) {
    wire::Writer writer;
    writer.big(sync).big(static_cast<std::uint16_t>(message.size())).bytes(message);
    writer.big_bytes(wire::crc24q(writer.written()), checksum_length);
    return writer.take();
}

} // namespace locus::gnss::rtcm3
