// Time Domain / Humatics PulsON P4xx radios (protocols.md 3): on USB without a checksum, on a UART with one, and over
// UDP one message a datagram. The radio ranges by itself (RangeNet), or is told to by `responders`.
#pragma once

#include "drivers/decoder.h"
#include "drivers/uwb/pulson/settings.h"

namespace locus::uwb::pulson {

std::unique_ptr<Decoder> make_usb(const void* settings);
std::unique_ptr<Decoder> make_uart(const void* settings);
std::unique_ptr<Decoder> make_udp(const void* settings);

} // namespace locus::uwb::pulson
