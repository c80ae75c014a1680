// A first position, velocity and clock from the satellites of one moment: least squares on the pseudoranges, with a
// clock for each constellation, then on their rates.
#pragma once

#include "fusion/estimators/gnss_ins_observations.h"

#include <array>
#include <optional>

namespace locus {

class GnssStart {
  public:
    /// Replaces what was heard of the same satellite.
    void keep(const SatelliteRange& range, Timestamp time) noexcept;

    /// None with fewer than four satellites (and one more for each constellation after the first), or when they do not
    /// agree.
    std::optional<GnssInsStart> solve(const GnssInsObservations& observations, Timestamp time) const noexcept;

  private:
    static constexpr std::size_t room = 40;
    struct Heard {
        SatelliteRange range;
        Timestamp time = Timestamp::min();
    };
    std::array<Heard, room> heard_{};
};

} // namespace locus
