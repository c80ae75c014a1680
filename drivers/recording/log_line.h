// One line of a *.log recording. CAN lines are candump's own: "(1700000000.123456) can0 123#DEADBEEF"; serial lines are
// "(seconds.microseconds) <input> serial#<hex> [<nanoseconds per byte>]": with the time of a byte, where the baud rate
// is known, a replay gives the same times of frames inside a chunk as the live run. Six fraction digits are written, on
// serial lines too: canplayer (2020.11) gives up on a file that has a line with more. The transports stamp in whole
// microseconds, so nothing is lost. Nine digits are read as well.
#pragma once

#include "drivers/packet.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace locus {

struct LogRecord {
    Timestamp time{}; ///< as written in the file; recordings of candump carry wall-clock time
    std::string input;
    Wire wire = Wire::bytes;
    Duration byte_time{0};
    std::uint32_t can_id = 0;
    bool can_fd = false;
    std::uint8_t can_fd_flags = 0;
    std::vector<std::uint8_t> data; ///< at most 64 bytes on CAN, 4096 on a serial line

    Packet packet() const { return {wire, time, byte_time, can_id, can_fd_flags, can_fd, data}; }
};

/// Without the line's end. `input` holds no blanks; `packet.time` is not negative.
std::string to_log_line(const std::string& input, const Packet& packet);

/// Empty when the line cannot be read; `error` says why. Blank lines and lines that begin with '#' give empty, no
/// error.
std::optional<LogRecord> from_log_line(std::string_view line, std::string& error);

} // namespace locus
