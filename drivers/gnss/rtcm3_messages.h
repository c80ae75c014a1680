// What is read of the messages of an RTCM 3 base station (RTCM 10403.3): where its antenna is (1005, 1006) and the
// pseudoranges at L1, of the older GPS messages (1002, 1004) and of multiple signal messages (MSM 4 to 7). Names of
// data fields (DF...) are those of the standard.
#pragma once

#include "drivers/gnss/rtcm3_bits.h"
#include "fusion/measurement.h"

#include <array>
#include <optional>
#include <span>

namespace locus::gnss::rtcm3 {

/// DF002 of a message; 0: too short to have one.
inline unsigned number_of(wire::Bytes message) {
    return message.size() < 2 ? 0 : static_cast<unsigned>(Bits{message}.take(12));
}

/// 1005, 1006: the antenna reference point. The height that 1006 adds is that over the surveyor's mark, which the
/// coordinates already hold (DF028).
struct AntennaPlace {
    std::uint16_t station = 0;
    Vec3 position_ecef_m{};
};

/// Empty when the length does not fit.
std::optional<AntennaPlace> parse_place(wire::Bytes message);

/// One pseudorange at L1.
struct Signal {
    double pseudorange_m = 0;
    float carrier_to_noise_dbhz = unknown_f;
    std::uint8_t satellite = 0;
    std::uint8_t signal = 0;       ///< sigId of u-blox
    std::uint8_t glonass_slot = 7; ///< frequency number + 7; where a message does not tell, as if it were 0
};

/// The pseudoranges of one message, of satellites in rising order.
struct Epoch {
    std::uint16_t station = 0;
    std::uint8_t constellation = 0;
    double time_s_in_gps_week = 0;
    std::size_t count = 0;
    std::array<Signal, 64> signals{};

    std::span<const Signal> heard() const { return {signals.data(), count}; }
};

/// What a message says of its epoch.
struct Reading {
    std::optional<Epoch> epoch; ///< empty: malformed, or its time lies in no week, or GLONASS does not tell the day
    bool malformed = false;     ///< it is shorter than what it says that it holds
};

constexpr bool is_place(unsigned number) { return number == 1005 || number == 1006; }
constexpr bool is_gps_extended(unsigned number) { return number == 1002 || number == 1004; }

/// 1002, 1004. Of GPS only C/A: codes P(Y) are delayed differently.
Reading parse_gps(wire::Bytes message);

} // namespace locus::gnss::rtcm3
