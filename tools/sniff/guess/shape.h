// What stays the same in frames of one kind: bytes at their begin, bytes at their end.
#pragma once

#include "tools/sniff/guess/lengths.h"

#include <optional>

namespace locus::sniff {

/// The byte that nearly all frames have `place` bytes after their begin. `shift` moves all begins, and the ends with
/// them.
std::optional<std::uint8_t> common_byte(wire::Bytes bytes, const std::vector<Cut>& frames, std::ptrdiff_t place);

/// The byte that nearly all frames have `place` bytes before their end (0: the last one).
std::optional<std::uint8_t> common_last_byte(wire::Bytes bytes, const std::vector<Cut>& frames, std::size_t place);

/// Each frame begun so many bytes earlier (and ended as well); those that would begin before the stream are left out.
std::vector<Cut> moved(const std::vector<Cut>& frames, std::ptrdiff_t earlier, std::size_t stream_bytes);

} // namespace locus::sniff
