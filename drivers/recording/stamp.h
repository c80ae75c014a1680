// Timestamps as decimal seconds, exact to the nanosecond: a double would lose it after 100 days of uptime.
#pragma once

#include "fusion/time.h"

#include <optional>
#include <string>
#include <string_view>

namespace locus {

/// Appends seconds with nine fraction digits: "12.000000345".
void append_seconds(std::string& text, Timestamp time);

/// Reads decimal seconds ("12", "-0.5", "1.7e9"), rounded to the nearest nanosecond. Empty when it is no number or
/// 9e9 seconds or more away from zero.
std::optional<Timestamp> parse_seconds(std::string_view text);

} // namespace locus
