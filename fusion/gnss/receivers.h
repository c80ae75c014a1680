// GNSS receivers with raw observations: what satellites broadcast and the signals of an epoch come in; satellite ranges
// go out, with all known errors taken out, and a fix of the epoch where the receiver tells none itself.
//
// An epoch is all signals of one receiver at one time of its clock. It is dealt with at the first tick that lies
// gather_s after its first signal came, or when a signal of the next epoch comes. Ephemerides are shared: what one
// receiver heard serves all.
#pragma once

#include "fusion/gnss/base_stations.h"
#include "fusion/gnss/ephemeris_book.h"
#include "fusion/gnss/epoch.h"
#include "fusion/gnss/single_point.h"

#include <vector>

namespace locus::gnss {

class Receivers {
  public:
    /// What becomes of the raw observations. The record is that of the observation: it and the satellite range made of
    /// it count as one.
    class Output {
      public:
        virtual ~Output() = default;
        /// A satellite range, to be judged by whoever takes it.
        virtual void take(const Measurement& range, const AidBook::Record& record) noexcept = 0;
        /// The last word on a raw observation.
        virtual void judge(const Measurement& raw, const AidBook::Record& record, Exclusion reason) noexcept = 0;
        /// A fix that the receiver did not tell.
        virtual void tell(const Measurement& fix) noexcept = 0;
    };

    /// An epoch never waits longer than `longest_wait`. Throws as SinglePointSolver does.
    Receivers(const Site& site, const GnssSettings& settings, Duration longest_wait);

    /// Words that come before the first raw observation are passed over: nobody knows the week yet.
    void hear(const GnssNavigation& words) noexcept;

    /// A pseudorange of a base station: kept for the receivers' next epochs.
    Exclusion hear(const GnssBaseRange& range, std::uint16_t input) noexcept { return bases_.hear(range, input); }

    /// A fix that a receiver tells itself.
    void hear(const GnssFix& fix, Timestamp time) noexcept;

    /// A GnssRaw. none: kept, and Output will hear of it.
    Exclusion hear(const Measurement& measurement, const AidBook::Record& record, Timestamp arrival,
                   Output& output) noexcept;

    /// Deals with every epoch whose time has come.
    void run(Timestamp tick, Output& output) noexcept;

  private:
    ReceiverEpoch* receiver_of(Address tag, std::uint16_t input) noexcept;
    void deal(ReceiverEpoch& epoch, Output& output) noexcept;
    void sight(ReceiverEpoch& epoch) noexcept;
    Exclusion sight(const GnssRaw& raw, const GnssRaw* accepted) noexcept;
    std::optional<SinglePoint> locate(ReceiverEpoch& epoch) noexcept;
    void observe_from_last(const ReceiverEpoch& epoch, const Sky& sky) noexcept;
    void give(const HeardSignal& signal, bool located, Output& output) const noexcept;
    bool tells_fixes(const ReceiverEpoch& epoch, Timestamp time) const noexcept;

    GnssSettings settings_;
    Duration gather_;
    std::optional<Eigen::Vector3d> site_ecef_m_;
    EphemerisBook ephemerides_;
    BaseStations bases_;
    SinglePointSolver solver_;
    std::vector<ReceiverEpoch> receivers_; ///< with their memory, in use or not
    std::size_t receiver_count_ = 0;
    std::vector<SightFrom> sights_; ///< of the epoch that is being dealt with
    std::optional<GpsTime> now_;
};

} // namespace locus::gnss
