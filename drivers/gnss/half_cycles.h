// Of which signals a receiver knows the carrier's half cycle. A doubt that stays changes nothing from epoch to epoch;
// where it begins or ends the carrier may jump by half a cycle.
#pragma once

#include "fusion/measurement.h"

#include <bitset>

namespace locus::gnss {

class HalfCycles {
  public:
    /// Whether the doubt is as it was at the last epoch that had the signal, or there was none.
    bool settled(const GnssRaw& raw, bool known) {
        const std::size_t at =
            (raw.constellation % constellations * signals + raw.signal % signals) * satellites + raw.satellite;
        const bool same = !heard_[at] || known_[at] == known;
        heard_[at] = true;
        known_[at] = known;
        return same;
    }
    void forget() { heard_.reset(); }

  private:
    static constexpr std::size_t constellations = 8, signals = 16, satellites = 256; ///< of u-blox's numbers
    std::bitset<constellations * signals * satellites> heard_, known_;
};

} // namespace locus::gnss
