// Every answer of the socket but POSE, each one JSON line of docs/protocol.md with its end of line.
#pragma once

#include "daemon/socket/command.h"
#include "daemon/socket/input_rates.h"
#include "daemon/socket/picture.h"
#include "daemon/socket/roster.h"

#include <string>
#include <string_view>
#include <vector>

namespace locus {

inline constexpr int protocol_major = 1;
inline constexpr int protocol_minor = 0;

/// What the program calls itself, e.g. "0.1.0".
std::string_view release();

std::string version_line(const Roster& roster);
std::string watch_line(const Watch& watch);
std::string sources_line(const Picture& picture, const Roster& roster, const InputRates& rates, Timestamp now);
std::string targets_line(const Picture& picture, const Roster& roster, Timestamp now);
std::string status_line(const Picture& picture, const Roster& roster, std::size_t clients, Timestamp now);
/// The newest POSE of every target, then POLL.
std::string poll_lines(const Picture& picture, const Roster& roster);
/// VIEW: bytes of a JPEG file in base64.
std::string view_line(const std::string& camera, const std::string& jpeg_base64);

std::string reload_line(bool ok, const std::vector<std::string>& problems);
std::string error_line(std::string_view message);

} // namespace locus
