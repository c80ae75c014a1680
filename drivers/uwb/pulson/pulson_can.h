// A P440 on CAN (protocols.md 3.5): the same messages over J1939. Up to 8 bytes stand in one frame of the group 0xEF00,
// longer ones are broadcast with the host's address folded into that group. How the radio wants to be asked for ranges
// over CAN is not published, so this decoder listens and only greets: let the radio range by itself (RangeNet).
#pragma once

#include "drivers/can_frame.h"
#include "drivers/decoder.h"
#include "drivers/uwb/pulson/settings.h"
#include "drivers/wire/bytes.h"

#include <vector>

namespace locus::uwb::pulson {

/// The frames in which a message goes from one address to another, by default from a radio to its host.
std::vector<CanFrame> can_frames(wire::Bytes message, std::uint8_t from = 0x80, std::uint8_t to = 1);

std::unique_ptr<Decoder> make_can(const void* settings);

} // namespace locus::uwb::pulson
