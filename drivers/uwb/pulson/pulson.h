// Time Domain / Humatics PulsON P4xx radios on a serial line (protocols.md 3): USB without a checksum, UART with one.
// The radio ranges by itself (RangeNet), or is told to by `responders`.
#pragma once

#include "drivers/decoder.h"
#include "drivers/uwb/pulson/settings.h"

namespace locus::uwb::pulson {

std::unique_ptr<Decoder> make_usb(const void* settings);
std::unique_ptr<Decoder> make_uart(const void* settings);

} // namespace locus::uwb::pulson
