// From a measurement to the sighting that the range filter takes, or the reason why it takes none: who is known, what
// can be true at all, and how noisy it is by the word of the device, the site or the settings, in this order.
#pragma once

#include "fusion/aid_status.h"
#include "fusion/estimators/reading_settings.h"
#include "fusion/site.h"
#include "fusion/uwb/sighting.h"

namespace locus {

class RangeReader {
  public:
    struct Reading {
        uwb::Sighting sighting;
        Exclusion reason = Exclusion::none; ///< none: the sighting is good
    };

    /// `site` outlives the reader.
    RangeReader(const Site& site, const ReadingSettings& settings) : site_(&site), settings_(settings) {}

    Reading read(const Measurement& measurement) const noexcept;

    /// Place of an anchor in the site, or uwb::Sighting::nobody.
    std::int16_t index_of(Address anchor) const noexcept;

  private:
    Reading read(const Range& range) const noexcept;
    Reading read(const RangeDifference& difference) const noexcept;
    Exclusion refusal(double value_m, LineOfSight line_of_sight) const noexcept;
    const Anchor& anchor(std::int16_t index) const { return site_->anchors[static_cast<std::size_t>(index)]; }

    const Site* site_;
    ReadingSettings settings_;
};

} // namespace locus
