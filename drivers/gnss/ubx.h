// u-blox receivers (UBX protocol): the receiver's own fixes, raw measurements of each signal and the navigation words
// of the satellites, out of one stream. What else the receiver says on the same line (NMEA, RTCM) counts as garbage: it
// is best switched off for the port.
//
// A measurement has the time at which its frame began to come in, which is some 50 ms after the epoch that it is for
// and shakes with the receiver's load. The epoch in GPS time stands in the messages (NavPvt::time_of_week_ms,
// RawEpoch::receiver_time_s): counted in milliseconds it is the counter of a device, and drivers/device_clock brings
// it to the host's clock like any other.
#pragma once

#include "drivers/decoder.h"

namespace locus::gnss {

struct UbxSettings {
    Address tag = no_address;
};

inline constexpr std::array ubx_options{
    required_option<&UbxSettings::tag>("tag", "Address of the target that carries it."),
};

/// NAV-PVT gives a GnssFix, RXM-RAWX a GnssRaw for each valid pseudorange, RXM-SFRBX a GnssNavigation, ESF-MEAS a
/// WheelSpeed where it holds a speed. Frames of other kinds are counted and left.
std::unique_ptr<Decoder> make_ubx(const void* settings);

} // namespace locus::gnss
