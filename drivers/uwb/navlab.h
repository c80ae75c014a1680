// Stanford NAV Lab's firmware for DW1000 nodes (protocols.md 1(a)), 115200 baud: a line a range, seven hex numbers:
//
//   0002 8000 0002 0000091d 000008f0 00000955 fffec780
//   source, anchor, tag, range, range corrected for power, raw range, received power
//
// Ranges in mm, corrected for the module's bias, and the power in thousandths of a dBm, all of them signed. There is no
// checksum: what does not fit the grammar is refused.
#pragma once

#include "drivers/decoder.h"

#include <optional>
#include <string>
#include <string_view>

namespace locus::uwb {

struct NavlabRange {
    std::uint64_t source = 0; ///< who printed it
    std::uint64_t anchor = 0;
    std::uint64_t tag = 0;
    std::int32_t range_mm = 0;
    std::int32_t range_by_power_mm = 0;
    std::int32_t range_raw_mm = 0;
    std::int32_t rx_power_thousandth_dbm = 0;

    bool operator==(const NavlabRange&) const = default;
};

/// Reads one line without its end.
std::optional<NavlabRange> parse_navlab_range(std::string_view line);

/// One line with "\r\n"; addresses that fit into 16 bits are written short.
std::string encode(const NavlabRange& range);

struct NavlabSettings {};

/// Gives a Range with the range that is corrected for bias.
std::unique_ptr<Decoder> make_navlab(const void* settings);

} // namespace locus::uwb
