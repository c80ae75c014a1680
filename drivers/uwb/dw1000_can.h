// DW1000 ranges and range differences over classic CAN in the layout of docs/can-dw1000.md and dw1000_can.dbc. There is
// no standard for it (protocols.md 1(e)), so this is ours: one frame a measurement, whole in itself, made for firmware
// that packs one 64-bit little-endian word.
#pragma once

#include "drivers/can_frame.h"
#include "drivers/decoder.h"

#include <optional>

namespace locus::uwb {

/// Bits of the payload. A range has one anchor, and the received power where a difference has its second anchor.
namespace dw1000_can {
inline constexpr CanSignal tag{0, 16};
inline constexpr CanSignal anchor_a{16, 8};
inline constexpr CanSignal anchor_b{24, 8};
inline constexpr CanSignal rx_power{24, 8};      ///< -0.5 dBm a step; 255: not known
inline constexpr CanSignal length_mm{32, 20};    ///< range unsigned, difference signed; none: 0xFFFFF, -0x80000
inline constexpr CanSignal sigma{52, 6};         ///< 2 cm a step from 2 cm; 63: not known
inline constexpr CanSignal line_of_sight{58, 2}; ///< as enum LineOfSight
inline constexpr CanSignal sequence{60, 4};

enum Kind : std::uint32_t { range = 0, range_difference = 1, kinds_per_node = 4 };
} // namespace dw1000_can

struct Dw1000CanSettings {
    int base_id = 0x340;
    int nodes = 1;
    int anchor_offset = 0;
    int tag_offset = 0;
};

inline constexpr std::array dw1000_can_options{
    option<&Dw1000CanSettings::base_id>("base_id", "", 0, 0x7C0, "First 11-bit identifier of the layout."),
    option<&Dw1000CanSettings::nodes>("nodes", "", 1, 16,
                                      "Senders on the bus; each has four identifiers from base_id on."),
    option<&Dw1000CanSettings::anchor_offset>("anchor_offset", "", 0, 65535,
                                              "Added to the number of an anchor to make its address."),
    option<&Dw1000CanSettings::tag_offset>("tag_offset", "", 0, 65535,
                                           "Added to the number of a tag to make its address."),
};

/// The frame of one measurement, values rounded to the layout's steps, power and sigma held to its limits. Empty when
/// an address or the length has no place in it. `node` below settings.nodes; of `sequence` the lowest 4 bits go out.
std::optional<CanFrame> encode(const Range& range, const Dw1000CanSettings& settings, unsigned node, unsigned sequence);
std::optional<CanFrame> encode(const RangeDifference& difference, const Dw1000CanSettings& settings, unsigned node,
                               unsigned sequence);

std::unique_ptr<Decoder> make_dw1000_can(const void* settings);

} // namespace locus::uwb
