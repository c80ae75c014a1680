// What goes out of an epoch: a SatelliteRange for each signal that can be used, a GnssFix of the single point.
#pragma once

#include "fusion/gnss/single_point.h"

namespace locus::gnss {

SatelliteRange satellite_range(const GnssRaw& raw, const SightFrom& from) noexcept;

GnssFix own_fix(Address tag, const SinglePoint& point) noexcept;

} // namespace locus::gnss
