// TREK1000 / EVK1000 and their HaoruTech descendants: one ASCII line a report over USB or UART (protocols.md 1(a)).
//
//   mc 07 000004ec 000008ee 0000087e 00000000 6cc0 0a 00a0642b a0:0
//   kind mask, one range in mm per anchor, long count, sequence, clock in ms, role and tag:anchor
//
// Firmwares differ in the number of range columns and the width of the last fields, so a line is read by its number of
// tokens. There is no checksum: what does not fit the grammar is refused.
#pragma once

#include "drivers/decoder.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace locus::uwb {

/// What the lines with ranges carry: `mc` bias-corrected, `mr` raw, `ma` between anchors.
struct TrekReport {
    static constexpr std::size_t max_ranges = 16;

    char kind = 'c';                                 ///< second letter of the line: 'c', 'r' or 'a'
    std::uint32_t mask = 0;                          ///< bit i: range i was measured in this cycle
    std::uint8_t columns = 4;                        ///< ranges on the line
    std::array<std::int32_t, max_ranges> range_mm{}; ///< to anchor i
    std::uint16_t long_count = 0;
    std::uint8_t sequence = 0; ///< counts the superframes of this tag
    std::uint32_t debug = 0;   ///< mc: milliseconds since the unit started; mr: antenna delays
    char role = 'a';           ///< which unit printed the line: 'a' anchor, 't' tag
    std::uint16_t tag = 0;
    std::uint16_t anchor = 0;

    bool operator==(const TrekReport&) const = default;
};

/// One line as the firmware prints it, with "\r\n".
std::string encode(const TrekReport& report);

/// Reads one line without its end. Empty when it does not fit the grammar, or the mask has bits beyond the columns.
std::optional<TrekReport> parse_trek_report(std::string_view line);

struct TrekSettings {
    int anchor_offset = 0;
    int tag_offset = 0;
};

inline constexpr std::array trek_options{
    option<&TrekSettings::anchor_offset>("anchor_offset", "", 0, 65535,
                                         "Added to the number of an anchor to make its address."),
    option<&TrekSettings::tag_offset>("tag_offset", "", 0, 65535, "Added to the number of a tag to make its address."),
};

/// Gives one Range per valid range of an `mc` line; `mr`, `ma` and `me` lines are frames without measurements.
std::unique_ptr<Decoder> make_trek1000(const void* settings);

} // namespace locus::uwb
