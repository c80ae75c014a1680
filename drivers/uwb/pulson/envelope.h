// How a PulsON message is wrapped on a serial line (protocols.md 3.1): A5 A5, its length, the message, and on a UART a
// CRC of the message.
#pragma once

#include "drivers/uwb/pulson/lengths.h"
#include "drivers/wire/checksum.h"
#include "drivers/wire/frame_stream.h"

namespace locus::uwb::pulson {

inline constexpr std::size_t head_size = 4;
inline constexpr std::size_t crc_size = 2;
inline constexpr std::uint8_t sync = 0xA5;

/// What both lines say of a head: enough bytes for the length, or that it is none.
struct Head {
    std::optional<Look> verdict; ///< empty: go on with `length`
    std::size_t length = 0;      ///< of the message
};

constexpr Head look_at_head(wire::Bytes bytes) {
    if (bytes[0] != sync || (bytes.size() > 1 && bytes[1] != sync)) return {Look::none(Refusal::garbage)};
    if (bytes.size() < head_size) return {Look::need(head_size)};
    const auto length = wire::big<std::uint16_t>(bytes, 2);
    if (length < 4 || length > longest_message) return {Look::none(Refusal::malformed)};
    return {std::nullopt, length};
}

/// Sync and length, the message, and room for `more` bytes behind it.
inline std::vector<std::uint8_t> with_head(wire::Bytes message, std::size_t more) {
    std::vector<std::uint8_t> frame(head_size + message.size() + more, sync);
    frame[2] = static_cast<std::uint8_t>(message.size() >> 8);
    frame[3] = static_cast<std::uint8_t>(message.size());
    std::ranges::copy(message, frame.begin() + head_size);
    return frame;
}

struct UartFormat {
    static constexpr std::size_t max_length = head_size + longest_message + crc_size;

    Look look(wire::Bytes bytes) const {
        const Head head = look_at_head(bytes);
        if (head.verdict) return *head.verdict;
        const std::size_t whole = head_size + head.length + crc_size;
        if (bytes.size() < whole) return Look::need(whole);
        const bool intact =
            wire::crc16_xmodem(message(bytes.first(whole))) == wire::big<std::uint16_t>(bytes, whole - crc_size);
        return intact ? Look::frame(whole) : Look::none(Refusal::bad_checksum);
    }
    static wire::Bytes message(wire::Bytes frame) {
        return frame.subspan(head_size, frame.size() - head_size - crc_size);
    }
    static std::vector<std::uint8_t> wrap(wire::Bytes message) {
        auto frame = with_head(message, crc_size);
        const std::uint16_t crc = wire::crc16_xmodem(message);
        frame[frame.size() - 2] = static_cast<std::uint8_t>(crc >> 8);
        frame[frame.size() - 1] = static_cast<std::uint8_t>(crc);
        return frame;
    }
};

/// Without a checksum: the type must be known, the length must be that of the type, and what has already come behind
/// it must be another head, else a message that lost a byte would take the first of its successor.
struct UsbFormat {
    static constexpr std::size_t max_length = head_size + longest_message;

    Look look(wire::Bytes bytes) const {
        const Head head = look_at_head(bytes);
        if (head.verdict) return *head.verdict;
        if (bytes.size() < head_size + 2) return Look::need(head_size + 2);
        const auto rule = length_rule(wire::big<std::uint16_t>(bytes, head_size));
        if (!rule) return Look::none(Refusal::unknown_type);
        const std::size_t whole = head_size + head.length;
        if (!rule->allows(head.length)) return Look::none(Refusal::malformed);
        if (bytes.size() < whole) return Look::need(whole);
        const bool fits = rule->allows(message(bytes.first(whole))) && begins_anew(bytes.subspan(whole));
        return fits ? Look::frame(whole) : Look::none(Refusal::malformed);
    }
    static wire::Bytes message(wire::Bytes frame) { return frame.subspan(head_size); }
    static std::vector<std::uint8_t> wrap(wire::Bytes message) { return with_head(message, 0); }

  private:
    static bool begins_anew(wire::Bytes after) {
        return std::ranges::all_of(after.first(std::min<std::size_t>(after.size(), 2)),
                                   [](std::uint8_t byte) { return byte == sync; });
    }
};

} // namespace locus::uwb::pulson
