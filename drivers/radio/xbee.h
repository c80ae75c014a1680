// Digi XBee in API mode: packets of other radios with their signal strength (protocols.md 7.1). 802.15.4 firmware puts
// it into each packet (0x80 to 0x83); ZigBee firmware (0x90, 0x91) does not, so the module is asked for it (AT DB)
// after each.
#pragma once

#include "drivers/decoder.h"
#include "drivers/wire/bytes.h"

#include <array>
#include <optional>
#include <vector>

namespace locus::radio {

struct XbeeSettings {
    Address receiver = no_address;
    bool escaped = false;
    bool ask_strength = true;
};

inline constexpr std::array xbee_options{
    option<&XbeeSettings::receiver>("receiver", "", -no_limit, no_limit, "Address of this radio.", {}, true),
    option<&XbeeSettings::escaped>("escaped", "Whether the module escapes bytes (AP=2)."),
    option<&XbeeSettings::ask_strength>("ask_strength",
                                        "Whether ZigBee firmware is asked for the strength after each packet."),
};

/// What a frame tells: a packet's source, its strength where the frame has it, or the answer to AT DB.
struct XbeeFrame {
    std::uint8_t type = 0;
    std::optional<std::uint64_t> source; ///< 16 or 64 bits
    std::optional<int> rssi_dbm;
    bool operator==(const XbeeFrame&) const = default;
};

/// `data` is the frame's data, without delimiter, length and checksum. Empty: malformed.
std::optional<XbeeFrame> parse_xbee(wire::Bytes data);
/// Delimiter, length, data, checksum; escaped where wanted.
std::vector<std::uint8_t> xbee_frame(wire::Bytes data, bool escaped = false);
/// A received packet of a type that carries the strength (0x80, 0x81), or the answer to AT DB (0x88).
std::vector<std::uint8_t> encode(const XbeeFrame& frame, bool escaped = false);

std::unique_ptr<Decoder> make_xbee(const void* settings);

} // namespace locus::radio
