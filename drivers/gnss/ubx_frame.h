// The frame of u-blox receivers (protocols.md 5.1): B5 62, class, id, length, payload, Fletcher's checksum over class
// to payload. The two sync bytes also stand inside payloads, so only the length and the checksum say what a frame is.
#pragma once

#include "drivers/wire/checksum.h"
#include "drivers/wire/frame_stream.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace locus::gnss::ubx {

inline constexpr std::array<std::uint8_t, 2> sync{0xB5, 0x62};
inline constexpr std::size_t head_length = 6;
inline constexpr std::size_t frame_overhead = head_length + 2;

struct Format {
    /// The longest that is decoded is RXM-RAWX with 255 signals.
    static constexpr std::size_t max_length = frame_overhead + 16 + 255 * 32;

    Look look(wire::Bytes bytes) const {
        const std::size_t shown = std::min(bytes.size(), sync.size());
        if (!std::equal(sync.begin(), sync.begin() + shown, bytes.begin())) return Look::none(Refusal::garbage);
        if (bytes.size() < head_length) return Look::need(head_length);
        const std::size_t length = frame_overhead + wire::little<std::uint16_t>(bytes, 4);
        if (length > max_length) return Look::none(Refusal::too_long);
        if (bytes.size() < length) return Look::need(length);
        const bool good =
            wire::fletcher8(bytes.subspan(2, length - 4)) == wire::little<std::uint16_t>(bytes, length - 2);
        return good ? Look::frame(length) : Look::none(Refusal::bad_checksum);
    }
};

/// Class and id as one number, in the order in which they are written: NAV-PVT is 0x0107.
using MessageId = std::uint16_t;

/// Of an intact frame.
inline MessageId message_id(wire::Bytes frame) { return wire::big<std::uint16_t>(frame, 2); }
inline wire::Bytes payload_of(wire::Bytes frame) { return frame.subspan(head_length, frame.size() - frame_overhead); }

/// A whole frame around a payload of at most 65535 bytes.
inline std::vector<std::uint8_t> frame(MessageId id, wire::Bytes payload) {
    wire::Writer writer;
    writer.bytes(sync).big(id).little(static_cast<std::uint16_t>(payload.size())).bytes(payload);
    writer.little(wire::fletcher8(writer.written().subspan(2)));
    return writer.take();
}

} // namespace locus::gnss::ubx
