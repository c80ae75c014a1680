// Small numbers for tags, in the order in which they come, so that what is known of them lies in rows.
#pragma once

#include "fusion/flat_index.h"
#include "fusion/measurement.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace locus::vision {

class TagNumbers {
  public:
    static constexpr std::uint16_t none = FlatIndex<Address>::none;

    /// For so many; no allocation after this.
    explicit TagNumbers(std::size_t most) : index_(most) { tags_.reserve(most); }

    /// none: it has no number.
    std::uint16_t find(Address tag) const noexcept { return index_.find(tag); }

    /// A new one where it has none yet; none: there is no room.
    std::uint16_t of(Address tag) noexcept {
        const auto known = index_.find(tag);
        const auto next = static_cast<std::uint16_t>(tags_.size());
        if (known != none || !index_.put(tag, next)) return known;
        tags_.push_back(tag);
        return next;
    }

    std::size_t size() const noexcept { return tags_.size(); }
    Address operator[](std::size_t number) const noexcept { return tags_[number]; }

  private:
    FlatIndex<Address> index_;
    std::vector<Address> tags_; ///< by number
};

/// The place in a table of as many as there may be that a camera's track has, or is to have: that of whom nobody has
/// seen for longest, which a free one is (`last` before all times).
template <class Tracks>
auto place_of_track(Tracks& tracks, std::uint32_t number, Timestamp never) noexcept {
    const auto place =
        std::ranges::find_if(tracks, [&](const auto& known) { return known.last != never && known.number == number; });
    return place != tracks.end() ? place : std::ranges::min_element(tracks, {}, [](const auto& t) { return t.last; });
}

} // namespace locus::vision
