// Measurement <-> one JSON line of a *.jsonl recording: {"t": seconds, "class": "RANGE", "input": 0, "sequence": 7,
// "anchor": 1, "tag": 0, "range_m": 2.5, ...}; fields are named as in fusion/measurement.h, unknown values are left
// out.
#pragma once

#include "fusion/measurement.h"

#include <optional>
#include <string>
#include <string_view>

namespace locus {

std::string to_json_line(const Measurement& measurement);

/// Empty when the line is not a measurement; `error` then says why in a sentence. Never throws.
std::optional<Measurement> from_json_line(std::string_view line, std::string& error);

} // namespace locus
