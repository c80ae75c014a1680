// What UWB radios cannot do: for formats without a checksum a last test of what they say.
#pragma once

namespace locus::uwb {

/// No DW1000 is heard that far.
inline constexpr double farthest_dw1000_m = 1e3;

} // namespace locus::uwb
