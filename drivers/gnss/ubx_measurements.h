// What the messages of u-blox receivers say, as measurements, and whether it can be.
#pragma once

#include "drivers/gnss/ubx_messages.h"
#include "fusion/measurement.h"

namespace locus::gnss::ubx {

/// A place on the Earth.
bool possible(const NavPvt& pvt);
/// A heading within one turn.
bool possible(const Heading& heading);
/// A time within the week.
bool possible(const RawEpoch& epoch);
/// Finite numbers, and a way no longer than one to a satellite.
bool possible(const RawSignal& signal);

/// Whether it is a heading: a line to a base station far off is none of the vehicle, and one whose cycles are not
/// settled points anywhere.
bool tells_heading(const RelativePosition& relative);

GnssFix fix_of(const NavPvt& pvt, Address tag);
Heading heading_of(const RelativePosition& relative, Address tag);
GnssRaw raw_of(const RawEpoch& epoch, const RawSignal& signal, Address tag);
/// Of a subframe with GnssNavigation::max_words at most.
GnssNavigation navigation_of(const Subframe& subframe, Address tag);

} // namespace locus::gnss::ubx
