// Which of the checksums that serial_layout knows guards these frames, if any.
#pragma once

#include "drivers/layout/serial_layout.h"
#include "tools/sniff/guess/lengths.h"

#include <optional>

namespace locus::sniff {

/// The layout with its checksum filled in. It must hold on nine of ten frames, and those must differ enough that no
/// checksum holds on them by chance: each that is not like another one lets 1 in 256 wrong guesses pass.
std::optional<layout::SerialLayoutSettings> with_checksum(const layout::SerialLayoutSettings& layout, wire::Bytes bytes,
                                                          const std::vector<Cut>& frames);

} // namespace locus::sniff
