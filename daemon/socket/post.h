// What goes between the main thread and the publisher: by handover, never by lock.
#pragma once

#include "daemon/handover.h"
#include "daemon/socket/roster.h"
#include "daemon/wake.h"

#include <cstdint>
#include <string>
#include <vector>

namespace locus {

/// A client's ?RELOAD;. The number finds the client again, if it is still there.
struct ReloadRequest {
    std::uint64_t client = 0;
};

struct ReloadAnswer {
    std::uint64_t client = 0;
    bool ok = false;
    std::vector<std::string> problems;
};

struct Post {
    Handover<const Roster> rosters;       ///< main -> publisher
    Handover<const ReloadAnswer> answers; ///< main -> publisher
    Ring<ReloadRequest, 8> requests;      ///< publisher -> main
    Wake publisher;
    Wake main;
};

} // namespace locus
