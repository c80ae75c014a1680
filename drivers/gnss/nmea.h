// GNSS receivers that talk NMEA 0183: the sentences of one moment become one fix. Position comes from GGA, velocity
// from RMC (or VTG where there is no RMC), standard deviations from GST. A fix goes out as soon as all kinds of
// sentence are there that came in the moment before, or when the next moment begins. It is dated by the time of day
// that its sentences tell, brought to the host's clock (epoch_clock.h); where use_receiver_time is false, its time is
// when the first of its sentences began to come in. No velocity upwards is told, so it is 0.
//
// HDT and THS give a Heading of their own. They tell no time, so they are dated by their reception.
#pragma once

#include "drivers/decoder.h"

namespace locus::gnss {

struct NmeaSettings {
    Address tag = no_address;
    bool need_checksum = true;
    /// Kaplan, Hegarty: Understanding GPS, 2nd ed., table 7.4: user range error of one frequency, 1 sigma.
    double range_error_m = 7.1;
    bool use_receiver_time = true;
};

inline constexpr std::array nmea_options{
    required_option<&NmeaSettings::tag>("tag", "Address of the target that carries it."),
    option<&NmeaSettings::need_checksum>("need_checksum", "Whether sentences without a checksum are refused."),
    option<&NmeaSettings::use_receiver_time>(
        "use_receiver_time", "Whether fixes are dated by the receiver's time of day; else by their reception. What is "
                             "common to all delays is taken off by delay_s."),
    option<&NmeaSettings::range_error_m>(
        "range_error_m", "m", 0.01, 100,
        "Where there is no GST: the horizontal sigma is this times the dilution of precision."),
};

/// One GnssFix a moment with a GGA that has a fix (quality 1 to 6, or 8) and an altitude, a Heading for each HDT and
/// each THS that is measured (A).
std::unique_ptr<Decoder> make_nmea(const void* settings);

} // namespace locus::gnss
