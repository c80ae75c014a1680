// The pose of one target told as NMEA 0183, so often a second, whatever the poses do: GNSS software takes silence for a
// broken receiver, and sentences that say "no position" for what they are.
#pragma once

#include "config/nmea_settings.h"
#include "daemon/nmea/terminal.h"
#include "fusion/geometry/earth.h"
#include "fusion/pose.h"

#include <optional>

namespace locus {

/// What the settings say of it, resolved.
struct NmeaPlan {
    NmeaOutputSettings settings;
    Address target = no_address;
    Wgs84Anchor origin;
};

class NmeaOutput {
  public:
    /// Throws std::runtime_error with a sentence when the terminal cannot be made.
    explicit NmeaOutput(const NmeaPlan& plan);

    /// Goes on by other settings. False: they name another terminal, and nothing has changed.
    bool follow(const NmeaPlan& plan);

    /// Poses of other targets do not matter.
    void take(const Pose& pose);
    /// Writes when it is time to. Never waits.
    void run(Timestamp now);

  private:
    NmeaPlan plan_;
    SiteOnEarth earth_;
    NmeaTerminal terminal_;
    std::optional<Pose> pose_;
    Timestamp next_{};
};

} // namespace locus
