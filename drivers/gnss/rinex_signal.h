// Which signal an observation code of RINEX 3 (table 4 to 10 of its description) is, in the numbers of u-blox.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace locus::gnss::rinex {

/// `band_and_attribute`: "1C", "2L", ... Empty for signals that u-blox has no number for, such as GPS L2 P(Y). Where
/// pilot and data are tracked together (X), the number is the pilot's. BeiDou's depend on the satellite: D2 is a signal
/// of its own.
std::optional<std::uint8_t> signal_of(std::uint8_t constellation, std::uint8_t satellite,
                                      std::string_view band_and_attribute);

} // namespace locus::gnss::rinex
