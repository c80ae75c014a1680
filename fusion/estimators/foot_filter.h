// The local visual filter of the federated estimator: one person's foot points through a filter of constant velocity.
// They come from a tracker that filters, so the error of one image is mostly that of the image before; that share is
// carried along as a state (fix_filter.h) and does not become smaller by being said often.
#pragma once

#include "fusion/aid_status.h"
#include "fusion/filter/fix_filter.h"
#include "fusion/filter/information_sum.h"
#include "fusion/measurement.h"

#include <cstdint>

namespace locus {

struct FootFilterModel {
    filter::FixFilterModel motion; ///< planar
    double gate_in_sigma = 4.3;    ///< of two coordinates together
    double beside_sigma_m = 0;     ///< of the tag beside the middle of the feet
    Duration patience{};           ///< after refusing for so long it believes the next one instead
    Duration memory{};             ///< after a longer silence it starts anew
};

class FootFilter {
  public:
    explicit FootFilter(const FootFilterModel& model) noexcept : model_(model), filter_(model.motion) {}

    /// `time` does not go back. The innovation is the distance on the floor, m.
    Verdict take(const FootPoint& foot, Timestamp time) noexcept;

    bool is_started() const noexcept { return filter_.is_started(); }
    /// Times that it went elsewhere because it was contradicted for too long.
    std::uint32_t jumps() const noexcept { return jumps_; }

    filter::PlaneKnowledge at(Timestamp time) const noexcept;

  private:
    FootFilterModel model_;
    filter::FixFilter filter_;
    std::uint32_t jumps_ = 0;
};

/// Of a state whose height counts for nothing.
filter::PlaneKnowledge plane_of(const Estimate& estimate) noexcept;

} // namespace locus
