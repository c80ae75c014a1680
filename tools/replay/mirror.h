// A recording as it would have been had time run backwards: the same path, the other way. Ranges and forces stay as
// they are, rates and velocities change their sign; so a filter that runs through it knows at each time what came after
// it.
#pragma once

#include "fusion/pose.h"

#include <optional>
#include <vector>

namespace locus::replay {

class Mirror {
  public:
    /// Times are mirrored so that `first` and `last` change places.
    Mirror(Timestamp first, Timestamp last) : sum_(first.time_since_epoch() + last.time_since_epoch()) {}

    Timestamp time(Timestamp time) const { return Timestamp{sum_ - time.time_since_epoch()}; }

    /// Empty for what has no mirror image: stamps of free-running clocks, a receiver's raw signals.
    std::optional<Measurement> measurement(const Measurement& measurement) const;

    Pose pose(Pose pose) const;

  private:
    Duration sum_;
};

} // namespace locus::replay
