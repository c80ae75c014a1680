// Chan's closed form: a position without a start. Step one takes the distance to the reference anchor (or the squared
// distance from the origin) for one more unknown, which makes the equations linear; step two brings it back in.
// Source: paper 000 eq. 3-7; for ranges the same two steps on r^2 = |x|^2 - 2 a.x + |a|^2.
#pragma once

#include "fusion/uwb/epoch.h"

#include <boost/container/static_vector.hpp>

namespace locus::uwb {

/// One point; two where the equations are just as many as the unknowns and a quadratic remains; none where there is no
/// closed form: pairs that do not hang together. Epoch's frame. A point may be far off: only ever a start.
using ChanPoints = boost::container::static_vector<Eigen::Vector3d, 2>;

template <int D>
ChanPoints chan_ranges(const Epoch& epoch) noexcept;

/// Pairs of any shape: brought to one reference by least squares first, their covariance carried along.
template <int D>
ChanPoints chan_differences(const Epoch& epoch) noexcept;

} // namespace locus::uwb
