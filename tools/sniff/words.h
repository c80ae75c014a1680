// What was found, as a person reads or types it.
#pragma once

#include "drivers/layout/serial_layout.h"
#include "drivers/wire/bytes.h"
#include "fusion/measurement.h"

#include <string>
#include <vector>

namespace locus::sniff {

/// "55 05 32 00 .. 9A": at most so many bytes of them.
std::string short_hex(wire::Bytes bytes, std::size_t most = 16);

/// "RANGE anchor 0x1 tag 0x0 range_m 2.5": the fields of a recording's line.
std::string short_words(Timestamp time, const Observation& observation);

/// The settings of a described layout as lines of YAML, each with its end, so many blanks in front.
std::string layout_text(const layout::SerialLayoutSettings& layout, std::size_t indent);

/// Which bytes of frames of one kind stay, count up or change: "0-1 always 55 05, 9 counts up, the rest changes".
std::string columns_text(const std::vector<std::vector<std::uint8_t>>& frames);

} // namespace locus::sniff
