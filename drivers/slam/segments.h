// Which poses of a SLAM lie on one path. It begins another one when it says so, when its stamps go back (it was started
// again), or when nothing came for long (it lost its way). A stamp that does not follow from the one before may also be
// a stray: a damaged line, a datagram that was overtaken. So one such pose is passed over, and only when the next
// follows from it was it a new beginning.
#pragma once

#include "fusion/time.h"

#include <cstdint>
#include <optional>

namespace locus::slam {

class Segments {
  public:
    explicit Segments(Duration longest_gap) : longest_gap_{longest_gap} {}

    /// The SLAM says that it lost its way: the next pose is of another segment.
    void lose() {
        if (last_) ++segment_;
        last_.reset();
        before_.reset();
        stray_.reset();
    }

    /// The SLAM names its map; the same name again changes nothing.
    void name(std::uint64_t map) {
        if (map_ != map) lose();
        map_ = map;
    }

    /// Segment of a pose; empty for a stray. `stamp`: in whatever clock, always the same one.
    std::optional<std::uint32_t> of(Timestamp stamp) {
        if (last_ && !goes_on(stamp)) {
            if (!follows(stamp, stray_)) {
                stray_ = stamp;
                return std::nullopt;
            }
            lose();
        }
        stray_.reset();
        last_ = stamp;
        return segment_;
    }

  private:
    Duration longest_gap_;
    std::uint32_t segment_ = 0;
    std::optional<std::uint64_t> map_;
    std::optional<Timestamp> last_, before_, stray_;

    bool follows(Timestamp stamp, const std::optional<Timestamp>& from) const {
        return from.has_value() && stamp >= *from && stamp - *from <= longest_gap_;
    }

    /// From the last, or from the one before it: then the last was the stray.
    bool goes_on(Timestamp stamp) {
        if (follows(stamp, last_))
            before_ = last_;
        else if (!follows(stamp, before_))
            return false;
        return true;
    }
};

} // namespace locus::slam
