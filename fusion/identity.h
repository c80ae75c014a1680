// Identity: whom a measurement concerns. It answers which tag a measurement speaks of and which sources it came from;
// the engine then knows the target by the tag and asks the site for the anchors.
#pragma once

#include "fusion/aid_status.h"
#include "fusion/measurement.h"
#include "fusion/site.h"

#include <array>
#include <cstddef>
#include <optional>

namespace locus {

/// A measurement as one target sees it. No tag: its kind names none (a camera's foot point, a clock sync).
struct Delivery {
    std::optional<Address> tag;
    SourceKind kind = SourceKind::anchor;
    std::array<Address, 2> sources{no_address, no_address};
    std::size_t source_count = 1;
};

/// A range between two tags concerns both, with the other as its source, and a sync packet first the anchor that heard
/// it, then the one that sent it; everything else concerns one target.
struct Deliveries {
    std::array<Delivery, 2> items;
    std::size_t count = 1;

    const Delivery* begin() const noexcept { return items.data(); }
    const Delivery* end() const noexcept { return items.data() + count; }
};

/// The end of a signal strength that does not move: the site settles which, where its receiver is an anchor.
Address beacon_of(const SignalStrength& strength, const Site& site) noexcept;

/// Of a signal strength the tag is the end that is no beacon.
Deliveries deliveries_of(const Measurement& measurement, const Site& site) noexcept;

/// Takes out of an anchor delivery the sources that the site knows. True when strangers are left: then the delivery
/// names only them, for it is they that are to be refused.
bool keep_strangers(Delivery& delivery, const Site& site) noexcept;

/// Whether every number that must be there is finite. NaN in sigma_* and *_dbm means "unknown" and is no fault.
bool is_finite(const Observation& observation) noexcept;

/// The one number that people are shown of an observation, in its own unit; 0 where no single number says it.
double shown_value(const Observation& observation) noexcept;

} // namespace locus
