// A CAN frame as candump writes it: "123#DEADBEEF", "12345678#R", "123##1DEADBEEF" (protocols.md 6.4).
#pragma once

#include "drivers/recording/log_line.h"

#include <string>
#include <string_view>

namespace locus {

/// A remote frame is written "#R": its length is not kept in a Packet, so that nobody takes it for data.
void append_can_text(std::string& text, const Packet& packet);

/// Fills the CAN fields and the data of `record`. False, with a sentence, when it is no such frame.
bool parse_can_text(std::string_view text, LogRecord& record, std::string& error);

/// The number of hex digits is the kind of the id: 3 standard, 8 extended (CAN_EFF_FLAG is set) or error frame.
bool parse_can_id(std::string_view hex, std::uint32_t& id);

} // namespace locus
