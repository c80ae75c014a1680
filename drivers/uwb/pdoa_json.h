// Decawave's PDoA and TWR node kits, and Ai-Thinker BU03/BU04 with that firmware (protocols.md 1(a)): a line each,
// "JS", four characters with the hex length of the JSON, and the JSON itself:
//
//   JS0076{"TWR": {"a16":"2E5C","R":3,"T":8605,"D":343,"P":1695,"Xcm":165,"Ycm":165,"O":14,"V":1,"X":53015,...}}
//
// A `TWR` object gives a Range; the others (SN, NewTag, TagAdded, KList, DList, Info) tell of the node itself. The
// angle that P, Xcm and Ycm tell has no measurement yet.
#pragma once

#include "drivers/decoder.h"

#include <optional>
#include <string>
#include <string_view>

namespace locus::uwb {

/// A `TWR` object.
struct PdoaReport {
    std::uint16_t tag = 0; ///< "a16"
    std::uint32_t sequence = 0;
    std::uint32_t slot_time = 0;
    std::int32_t distance_cm = 0;
    std::int32_t phase_difference = 0; ///< as the firmware counts it
    std::int32_t x_cm = 0;
    std::int32_t y_cm = 0;
    std::int32_t clock_offset_hundredth_ppm = 0;
    std::uint32_t flags = 0;
    std::array<std::uint16_t, 3> acceleration_mg{}; ///< two's complement

    bool operator==(const PdoaReport&) const = default;
};

/// What stands behind "JS": whether its length is right, and what it tells if it is a TWR object with tag and distance.
enum class PdoaLine : std::uint8_t { damaged, other, report };
PdoaLine parse_pdoa_line(std::string_view line, PdoaReport& report);

/// One line with "\r\n".
std::string encode(const PdoaReport& report);

struct PdoaSettings {
    Address anchor = address(0);
};

inline constexpr std::array pdoa_options{
    required_option<&PdoaSettings::anchor>("anchor", "Address of the node on this line, which does not tell its own."),
};

std::unique_ptr<Decoder> make_pdoa_json(const void* settings);

} // namespace locus::uwb
