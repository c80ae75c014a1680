// Witnesses: where each target is by all that it heard but cameras. A camera's track is named by comparing it with
// these, and not with poses that its own feet went into: else a wrong name would prove itself and never be taken back.
// Each is a second timeline of its target, so a target takes twice the work where there are cameras.
#pragma once

#include "fusion/target_table.h"
#include "fusion/vision/identity.h"

#include <span>
#include <vector>

namespace locus::vision {

class Witnesses {
  public:
    /// For all places of `targets`, which outlives this; without cameras there are none.
    Witnesses(const TargetTable& targets, bool cameras);

    /// What the target's own timeline took, if it is not of a camera.
    void hear(TargetTable::Slot slot, const Measurement& measurement, const SampleKey& key) noexcept;

    void run(Timestamp tick, Timestamp horizon) noexcept;

    /// All tags that have a position, at `time`, shortly before the last run(). Valid until the next call.
    std::span<const LocatedTag> locate(Timestamp time) noexcept;

  private:
    const TargetTable& targets_;
    std::vector<Timeline> timelines_; ///< by slot
    AidBook unread_;                  ///< the targets' own timelines tell what became of a measurement
    std::vector<LocatedTag> located_;
    Timestamp tick_{};
};

} // namespace locus::vision
