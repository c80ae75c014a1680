// Are both threads alive? The watchdog is fed only when the heartbeats of fusion and publisher have both moved since it
// was fed last, so a process that merely exists is restarted. Pure.
#pragma once

#include <cstdint>

namespace locus {

class VitalSigns {
  public:
    /// True: both moved since the last time this was true.
    bool both_moved(std::uint64_t fusion, std::uint64_t publisher) {
        if (fusion == fusion_ || publisher == publisher_) return false;
        fusion_ = fusion;
        publisher_ = publisher;
        return true;
    }

  private:
    std::uint64_t fusion_ = 0;
    std::uint64_t publisher_ = 0;
};

} // namespace locus
