// A signal and the satellite that sent it: the pseudorange brought together with the ephemeris, before anything is
// known of where the receiver is.
#pragma once

#include "fusion/aid_status.h"
#include "fusion/gnss/ephemeris_collector.h"
#include "fusion/gnss/range_noise.h"

#include <Eigen/Core>

#include <optional>

namespace locus::gnss {

struct Sight {
    Eigen::Vector3d satellite_ecef_m;  ///< when it sent, in the Earth's frame of that moment
    Eigen::Vector3d velocity_ecef_mps; ///< alike
    double code_m = 0;                 ///< pseudorange, satellite's clock and group delay taken out
    double carrier_m = 0;              ///< alike; 0: none
    double rate_mps = 0;               ///< of the pseudorange, satellite's drift taken out; NaN: none
    double carrier_hz = 0;
    Reception reception; ///< its elevation is filled in by whoever knows the place
};

/// Receiver's time of reception of a raw observation.
inline GpsTime time_of(const GnssRaw& raw) { return {raw.gps_week, raw.receiver_time_s_in_gps_week}; }

/// Whether a satellite of these constellations can have such a pseudorange; clocks of receivers are up to some
/// milliseconds off.
bool is_possible_pseudorange(double pseudorange_m) noexcept;

/// Empty when the ephemeris puts the satellite nowhere, whatever the words said.
std::optional<Sight> sight_of(const GnssRaw& raw, const Ephemeris& ephemeris) noexcept;

/// Where the satellite was (or its velocity), in the Earth's frame `travel_s` later.
Eigen::Vector3d turned(const Eigen::Vector3d& ecef, double travel_s) noexcept;

} // namespace locus::gnss
