// All targets: a slot with a timeline for each, set aside at construction. The configured targets hold the first slots;
// an unknown tag takes the next free one when it is first heard and keeps it.
#pragma once

#include "fusion/flat_index.h"
#include "fusion/fresh_estimators.h"
#include "fusion/timeline.h"

#include <string>
#include <string_view>
#include <vector>

namespace locus {

class TargetTable {
  public:
    using Slot = std::uint16_t;
    static constexpr Slot none = FlatIndex<Address>::none;

    /// Throws std::invalid_argument when the configured targets cannot be had.
    TargetTable(const EngineSettings& settings, FreshEstimators& fresh);

    /// The slot of a tag, opened now if the tag is a stranger, or a person without one, and may have one; else `none`.
    Slot slot_of(Address tag) noexcept;

    /// The slot of a tag that has one; else `none`.
    Slot find(Address tag) const noexcept { return slots_.find(tag); }

    /// Slots in use: 0 .. size() - 1.
    std::size_t size() const noexcept { return used_; }
    /// Slots in all.
    std::size_t room() const noexcept { return targets_.size(); }
    Address address(std::size_t slot) const noexcept { return targets_[slot].address; }
    Timeline& timeline(std::size_t slot) noexcept { return targets_[slot].timeline; }
    const Timeline& timeline(std::size_t slot) const noexcept { return targets_[slot].timeline; }
    std::string_view name(std::size_t slot) const noexcept { return targets_[slot].name; }

    /// A pose that holds all that never changes of the slot's target.
    Pose blank_pose(Slot slot) const noexcept;

  private:
    struct Target {
        std::string name;
        Address address;
        std::uint16_t estimator; ///< row of estimator_table()
        Timeline timeline;
    };

    void add(const TargetSettings& settings, const FreshEstimators::Item& fresh, const TimelineLimits& limits);
    Slot open(Address tag) noexcept;

    FlatIndex<Address> slots_;
    bool accepts_strangers_;
    std::vector<Target> targets_; ///< strangers have slots only if they are to be followed
    std::size_t used_ = 0;
};

} // namespace locus
