// u-blox receivers (UBX protocol): the receiver's own fixes, the heading of two antennas, raw measurements of each
// signal and the navigation words of the satellites, out of one stream. What else the receiver says on the same line
// (NMEA, RTCM) counts as garbage: it is best switched off for the port.
//
// Fixes and raw measurements are dated by the receiver: the epoch that stands in NAV-PVT, NAV-RELPOSNED and RXM-RAWX is
// brought to the host's clock (epoch_clock.h), so that neither the receiver's load nor the line shakes it. Messages
// that tell no time, and all where use_receiver_time is false, have the time at which their frame began to come in.
#pragma once

#include "drivers/decoder.h"

namespace locus::gnss {

struct UbxSettings {
    Address tag = no_address;
    bool use_receiver_time = true;
};

inline constexpr std::array ubx_options{
    required_option<&UbxSettings::tag>("tag", "Address of the target that carries it."),
    option<&UbxSettings::use_receiver_time>(
        "use_receiver_time", "Whether fixes and raw measurements are dated by the receiver's time of week; else by "
                             "their reception. What is common to all delays is taken off by delay_s."),
};

/// NAV-PVT gives a GnssFix, NAV-RELPOSNED of a moving base with its cycles fixed a Heading, RXM-RAWX a GnssRaw for each
/// valid pseudorange, RXM-SFRBX a GnssNavigation, ESF-MEAS a WheelSpeed where it holds a speed. Frames of other kinds
/// are counted and left.
std::unique_ptr<Decoder> make_ubx(const void* settings);

} // namespace locus::gnss
