// How long to wait before a lost device is tried again: doubling, so a pulled cable costs no processor time, with a
// cap, so a cable put back is noticed soon. No jitter: nobody else competes for the device, and the times stay
// predictable for whoever reads the log.
#pragma once

#include "fusion/time.h"

#include <algorithm>

namespace locus {

class BackOff {
  public:
    static constexpr Duration first = std::chrono::milliseconds{100};
    static constexpr Duration cap = std::chrono::seconds{2};

    /// The wait before the next try.
    Duration next() {
        const Duration wait = wait_;
        wait_ = std::min(2 * wait_, cap);
        return wait;
    }

    /// The device works: the next loss is tried again at once.
    void reset() { wait_ = first; }

  private:
    Duration wait_ = first;
};

} // namespace locus
