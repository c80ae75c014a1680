// Where log lines go: to stderr by a thread of their own, with journald's priorities in front when journald listens
// there. When lines come faster than they can be written, the oldest are lost: nobody waits for the log.
#pragma once

#include <string>

namespace locus {

/// Makes spdlog's default logger. `level` is one of config's log_levels. Call it once, from main().
void start_log(const std::string& level);

void set_log_level(const std::string& level);

/// Writes what waits and ends the log's thread.
void end_log();

} // namespace locus
