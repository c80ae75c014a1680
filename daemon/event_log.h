// What an input or a camera does, as lines of the log: a loose plug comes and goes ten times a second, so not all.
#pragma once

#include "daemon/rate_limit.h"
#include "drivers/input.h"

#include <string>

namespace locus {

class EventLog {
  public:
    /// `what`: "input \"hall\"".
    explicit EventLog(std::string what) : what_{std::move(what)} {}

    /// From one thread.
    void tell(const InputEvent& event);

  private:
    std::string what_;
    RateLimit lines_{20, std::chrono::seconds{5}};
};

} // namespace locus
