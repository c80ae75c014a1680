// Multiple signal messages (RTCM 10403.3, 3.5.16): a mask of satellites, one of signals, one of the pairs of both that
// were measured (cells), then field by field the figures of all satellites, then those of all cells. A pseudorange is
// the rough range of the satellite and the fine one of the cell, in milliseconds of light.
#pragma once

#include "drivers/gnss/rtcm3_messages.h"

namespace locus::gnss::rtcm3 {

/// Full pseudoranges of a constellation that is known: 107x GPS, 108x GLONASS, 109x Galileo, 111x QZSS, 112x BeiDou,
/// with x from 4 to 7.
bool is_msm(unsigned number);

/// Of each satellite the first signal at L1 in the order of the signal mask. `message`: one for which is_msm().
Reading parse_msm(wire::Bytes message);

} // namespace locus::gnss::rtcm3
