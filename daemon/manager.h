// What the service manager is told (sd_notify(3)); without one, all of this does nothing.
#pragma once

#include "fusion/time.h"

#include <optional>
#include <string>

namespace locus {

class Manager {
  public:
    Manager();
    void ready();
    void reloading();
    void stopping();
    /// Goes out only when the text is another than before, at most once a second.
    void status(const std::string& text, Timestamp now);
    /// Feeds the watchdog.
    void alive();
    /// Whether it is time to feed it: four times within its limit. False where there is no watchdog.
    bool is_due(Timestamp now) const;

  private:
    std::optional<Duration> feed_every_;
    Timestamp fed_{};
    std::string status_;
    Timestamp told_{};
};

} // namespace locus
