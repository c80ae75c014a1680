// Bitcraze's Loco positioning node as a sniffer (protocols.md 1(d)): every packet of the anchors around with the time
// at which it came, as a line of text or, after a `b` was sent to it, as a binary record; both are read. The sniffer
// then is a tag that only listens, wherever it is carried: TDoA2 and TDoA3 give range differences. Two-way ranging that
// it overhears is counted and gives nothing.
#pragma once

#include "drivers/decoder.h"
#include "drivers/wire/bytes.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace locus::uwb {

struct LocoSnifferSettings {
    Address tag = no_address;
    int anchor_offset = 0;
};

inline constexpr std::array loco_sniffer_options{
    option<&LocoSnifferSettings::tag>("tag", "", -no_limit, no_limit, "Address of the target that carries it.", {},
                                      true),
    option<&LocoSnifferSettings::anchor_offset>("anchor_offset", "", 0, 65535,
                                                "Added to the number of an anchor to make its address."),
};

namespace loco {

inline constexpr std::size_t longest_payload = 104; ///< of 127 bytes on the air, less header and FCS

struct Sniffed {
    std::uint64_t rx_ticks = 0; ///< 40 bits of the sniffer's own clock
    std::uint8_t from = 0;
    std::uint8_t to = 0xFF; ///< all
    wire::Bytes payload;    ///< stands in what it was read from
};

/// A whole binary record, `BC` first. Empty when its two lengths differ.
std::optional<Sniffed> parse_record(wire::Bytes record);
std::vector<std::uint8_t> encode_record(const Sniffed& packet);

/// A line as "From 01 to ff @0a3a5f2200: 3015...", without its end; the payload's bytes go into `buffer`.
std::optional<Sniffed> parse_line(std::string_view line, std::array<std::uint8_t, longest_payload>& buffer);
std::string encode_line(const Sniffed& packet);

} // namespace loco

std::unique_ptr<Decoder> make_loco_sniffer(const void* settings);

} // namespace locus::uwb
