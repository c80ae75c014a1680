// Gathers what a tag hears into epochs and makes one Chan-Taylor position of each. An epoch is over when its time is,
// or when an anchor speaks for the second time after there was a position: so a sweep over all anchors is one epoch
// however long the setting, and no measurement goes into two of them. While an epoch lasts, its position is made anew
// with every measurement, so nothing waits for the end.
#pragma once

#include "fusion/estimators/epoch_settings.h"
#include "fusion/estimators/range_reader.h"
#include "fusion/estimators/used_kinds.h"
#include "fusion/pose.h"
#include "fusion/uwb/epoch_keeper.h"

#include <optional>

namespace locus {

class EpochGatherer {
  public:
    /// What a position is made from: its own epoch, or the newest of each anchor within the last epoch_s.
    enum class Reach { epoch, sliding };

    struct News {
        Exclusion reason = Exclusion::none; ///< of the measurement
        bool opens_epoch = false;           ///< it is the first of an epoch
        std::optional<uwb::Fix> fix;        ///< of the epoch, or window, with it
    };

    /// `site` outlives the gatherer.
    EpochGatherer(const Site& site, const EpochEstimatorSettings& settings, Reach reach);

    News take(const Measurement& measurement) noexcept;

    /// Fills in time, kinds_used and what is missing.
    void describe(Timestamp time, Estimate& estimate) const noexcept;

  private:
    bool is_over(const uwb::Sighting& sighting, Timestamp time) const noexcept;
    Exclusion judge(const uwb::EpochKeeper::Answer& answer, const Measurement& measurement) noexcept;

    RangeReader reader_;
    uwb::EpochKeeper keeper_;
    Duration epoch_;
    Reach reach_;
    std::optional<Timestamp> opened_;
    std::optional<Timestamp> fixed_; ///< time of the last position
    UsedKinds used_;
    Missing missing_ = Missing::measurements;
};

} // namespace locus
