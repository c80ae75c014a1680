// What a track expects of a sighting: the geometry, and beside it the errors that the sighting's anchors carry along
// from one measurement to the next, kept as wandering states of the track.
#pragma once

#include "fusion/filter/wandering_state.h"
#include "fusion/uwb/sighting.h"

namespace locus {

/// A sigma of zero: there is no such error.
struct CarriedErrors {
    filter::WanderModel anchor; ///< of each anchor, soon another
    filter::WanderModel offset; ///< of each anchor in its ranges, for good or nearly so
    filter::WanderModel common; ///< of all ranges alike; differences are free of it
};

template <class Track>
struct RangeExpectation {
    double innovation_m = 0;         ///< sighting less prediction
    typename Track::Vector jacobian; ///< of the prediction by the state
};

/// Gives the errors that are new a place in the state. Paper 001 eq. 5-7.
template <class Track>
RangeExpectation<Track> expect(const uwb::Sighting& sighting, const Site& site, const CarriedErrors& errors,
                               Track& track) noexcept;

} // namespace locus
