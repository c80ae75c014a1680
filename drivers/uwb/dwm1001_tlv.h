// DWM1001 modules with Decawave's PANS, asked over UART (protocols.md 1(b)), 115200 baud: `0C 00` is answered by
//
//   40 01 err, 41 0D position, and 49 (a tag: its distances to anchors) or 48 (an anchor: its distances to tags)
//
// The module must be in this mode, in which it starts; `quit` leaves the shell. Neither checksum nor sync: what does
// not fit in every length and limit is refused.
#pragma once

#include "drivers/decoder.h"
#include "drivers/uwb/list.h"
#include "drivers/wire/frame_stream.h"

#include <optional>
#include <vector>

namespace locus::uwb {

namespace dwm1001 {

struct TlvPosition {
    std::array<std::int32_t, 3> position_mm{};
    std::uint8_t quality_percent = 0;

    bool operator==(const TlvPosition&) const = default;
};

struct TlvDistance {
    std::uint64_t address = 0; ///< 16 bits of it in the reply of a tag
    std::uint32_t distance_mm = 0;
    std::uint8_t quality_percent = 0;
    TlvPosition position; ///< of the anchor; reply of a tag only

    bool operator==(const TlvDistance&) const = default;
};

/// Answer to loc_get.
struct TlvReply {
    enum class From : std::uint8_t { nobody, tag, anchor };
    static constexpr std::size_t max_distances = 16; ///< a module gives 4 as a tag

    std::uint8_t error = 0; ///< 0: good; then the rest is there
    TlvPosition position;
    From from = From::nobody; ///< nobody: no distances
    List<TlvDistance, max_distances> distances;

    bool operator==(const TlvReply&) const = default;
};

inline constexpr std::size_t position_reply_size = 3 + 15; ///< of a reply without distances

struct TlvFormat {
    static constexpr std::size_t max_length = position_reply_size + 2 + 255;
    static Look look(std::span<const std::uint8_t> bytes);
};

/// One whole reply that TlvFormat found. Empty when a quality is above 100 %.
std::optional<TlvReply> parse_tlv_reply(std::span<const std::uint8_t> bytes);

/// At most 12 distances fit into a tag's reply: its length is one byte.
std::vector<std::uint8_t> encode(const TlvReply& reply);

} // namespace dwm1001

struct Dwm1001TlvSettings {
    Address tag = address(0);
    Address anchor = address(0);
    double poll_period_s = 0.1;
};

inline constexpr std::array dwm1001_tlv_options{
    option<&Dwm1001TlvSettings::tag>("tag", "Address of the module, where it is a tag: it does not tell its own."),
    option<&Dwm1001TlvSettings::anchor>("anchor", "Address of the module, where it is an anchor."),
    option<&Dwm1001TlvSettings::poll_period_s>("poll_period_s", "s", 0.01, 60,
                                               "How often it is asked; it has something new ten times a second."),
};

std::unique_ptr<Decoder> make_dwm1001_tlv(const void* settings);

} // namespace locus::uwb
