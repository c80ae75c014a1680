// The grid that estimators read, and in whose place another may come while they run: the same places and beacons with
// other strengths, as the map learns. All of it in the thread that the estimators run in.
#pragma once

#include "fusion/radio/strength_grid.h"

#include <memory>
#include <utility>

namespace locus::radio {

class GridInUse {
  public:
    using Shared = std::shared_ptr<const StrengthGrid>;

    bool is_empty() const noexcept { return grid_ == nullptr; }
    void fill(Shared grid) noexcept { grid_ = std::move(grid); }
    /// Not when empty.
    const StrengthGrid& grid() const noexcept { return *grid_; }

    /// `other` comes into use and what was in use comes back. False, and nothing changes: it is of other places or
    /// beacons.
    bool exchange(Shared& other) noexcept {
        if (other == nullptr || is_empty() || !fits(*other)) return false;
        grid_.swap(other);
        return true;
    }

  private:
    bool fits(const StrengthGrid& other) const noexcept {
        return other.cells().count() == grid_->cells().count() && other.beacons() == grid_->beacons();
    }

    Shared grid_;
};

} // namespace locus::radio
