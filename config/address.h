// Addresses as engineers type them: a TREK index, a short address, or the EUI printed on the board.
#pragma once

#include "fusion/measurement.h"

#include <optional>
#include <string>
#include <string_view>

namespace locus::config {

/// Decimal, 0x hexadecimal, or two or eight hexadecimal bytes with ':' or '-' between, highest first. Empty when it is
/// none of these or does not fit in 64 bits.
std::optional<Address> parse_address(std::string_view text);

/// Decimal below 256 (a TREK index), else 0x hexadecimal; parse_address() reads it back.
std::string to_text(Address address);

} // namespace locus::config
