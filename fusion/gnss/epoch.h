// What one receiver measured at one moment of its clock, kept until all of it has come.
#pragma once

#include "fusion/aid_book.h"
#include "fusion/gnss/gnss_time.h"

#include <optional>
#include <vector>

namespace locus::gnss {

struct HeardSignal {
    Measurement measurement; ///< of a GnssRaw
    AidBook::Record record;
    Exclusion reason = Exclusion::none;
    std::size_t sight = 0; ///< its index, where the reason is none

    const GnssRaw& raw() const { return *std::get_if<GnssRaw>(&measurement.observation); }
};

struct ReceiverEpoch {
    /// Receivers of today track some 60 signals at L1 and twice as many in all.
    static constexpr std::size_t most_signals = 160;

    Address tag = no_address;
    std::uint16_t input = 0;
    GpsTime time; ///< of the signals in it, or of the last one that was dealt with
    Timestamp first_arrival{};
    std::vector<HeardSignal> signals; ///< empty: dealt with
    bool begun = false;               ///< `time` says something

    // What stays from epoch to epoch.
    std::optional<Eigen::Vector3d> position_ecef_m;
    GpsTime position_time;
    std::optional<Timestamp> told_fix; ///< when the receiver last told a fix itself
};

} // namespace locus::gnss
