// Measurement <-> one JSON line of a *.jsonl recording: {"t": seconds, "class": "RANGE", "input": 0, "sequence": 7,
// "anchor": 1, "tag": 0, "range_m": 2.5, ...}; fields are named as in fusion/measurement.h, unknown values are left
// out. Only where a sample has a sequence number of its own beside the measurement's is it called `blink_sequence`
// (ARRIVAL) and `sync_sequence` (CLOCK_SYNC). Numbers come back to the bit, `t` to the nanosecond.
#pragma once

#include "fusion/measurement.h"

#include <optional>
#include <string>
#include <string_view>

namespace locus {

/// A line without the newline. A value that is not finite is left out, whatever it is.
std::string to_json_line(const Measurement& measurement);

/// Empty when the line is not a measurement; `error` then says why in a sentence: a field that is missing, unknown,
/// there twice, of the wrong type or out of its type's range, a time 9e9 s or more away from zero. Never throws.
std::optional<Measurement> from_json_line(std::string_view line, std::string& error);

} // namespace locus
