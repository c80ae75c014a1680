// A GNSS base station that speaks RTCM 3 (a caster's stream, a receiver's port, str2str): where its antenna is and its
// pseudoranges at L1, from which fusion/gnss makes corrections for receivers nearby. Messages of other kinds (carriers
// alone, ephemerides, texts) are counted as frames and left.
//
// What it measured is dated by its own time inside the measurement; the stamp is that of reception, so that what the
// network delays is not refused as late.
#pragma once

#include "drivers/decoder.h"

namespace locus::gnss {

/// None: the stream says all itself.
struct Rtcm3Settings {};

/// 1005 and 1006 tell the place; 1002, 1004 and MSM 4 to 7 of GPS, GLONASS, Galileo, QZSS and BeiDou give a
/// GnssBaseRange for each satellite's pseudorange, with the place that the same station told last.
std::unique_ptr<Decoder> make_rtcm3(const void* settings);

} // namespace locus::gnss
