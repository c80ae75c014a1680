// What one satellite's line of an observation file holds of each of its signals.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace locus::gnss::rinex {

struct Signal {
    std::string_view code; ///< band and attribute: "1C"
    std::optional<double> range_m{}, carrier_cycles{}, doppler_hz{}, strength_dbhz{};
    bool slipped = false;    ///< the carrier, since the epoch before
    bool half_cycle = false; ///< it may be half a cycle off (RINEX 3.05, table A2)
};

/// In the order of `types` (codes of three letters: what is measured, band, attribute), which outlive the result.
/// A value that is blank or 0 is missing. `error`: the last that cannot be read, in a sentence.
std::vector<Signal> signals_of(std::string_view line, const std::vector<std::string>& types, std::string& error);

} // namespace locus::gnss::rinex
