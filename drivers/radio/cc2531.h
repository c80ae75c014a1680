// Records of TI's CC2531 packet sniffer, brought to a serial line by whatever reads its USB endpoint
// (protocols.md 7.3): how strongly every 802.15.4 radio around is heard, without being a member of its network.
#pragma once

#include "drivers/decoder.h"
#include "drivers/wire/bytes.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace locus::radio {

struct Cc2531Settings {
    Address receiver = no_address;
    double rssi_offset_db = -73;
};

inline constexpr std::array cc2531_options{
    option<&Cc2531Settings::receiver>("receiver", "", -no_limit, no_limit, "Address of this radio.", {}, true),
    option<&Cc2531Settings::rssi_offset_db>("rssi_offset_db", "dB", -150, 0,
                                            "What a raw strength of zero is worth; -73 by the chip's data sheet."),
};

/// One packet as it was heard. Its last two bytes on the air, the FCS, are replaced by what the radio measured.
struct Cc2531Record {
    std::uint32_t timestamp_ticks = 0; ///< 32 a microsecond, in the sniffer's clock
    wire::Bytes frame;                 ///< without those two bytes; stands in the record
    std::int8_t raw_rssi = 0;
    bool crc_good = true;
    std::uint8_t correlation = 0; ///< 7 bits
};

/// `bytes` are one whole record, as the stream's format found it.
Cc2531Record parse_cc2531(wire::Bytes bytes);
/// `record.frame` has up to 125 bytes.
std::vector<std::uint8_t> encode(const Cc2531Record& record);

std::unique_ptr<Decoder> make_cc2531(const void* settings);

} // namespace locus::radio
