// The stream of poses: how it is asked for, and the poses that come.
#pragma once

#include "tools/client/client.h"

#include <optional>
#include <string>
#include <vector>

namespace locus::tools {

struct WatchRequest {
    std::vector<std::string> targets; ///< empty: all
    std::optional<double> rate_hz;    ///< at most so many poses of each target a second; empty: all
    bool readings = false;            ///< also what radios heard
};

/// The ?WATCH command. Names may hold any character.
std::string watch_command(const WatchRequest& request);

/// Asks for the stream. Throws DaemonError with the daemon's own sentence when it refuses.
void start_watching(Client& client, const WatchRequest& request);

/// Now and so many seconds more; the end of all days when that is beyond it.
Deadline deadline_in(double seconds);

} // namespace locus::tools
