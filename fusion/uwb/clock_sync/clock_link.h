// The link from a transmitter's sync packets to one receiver: the track that is believed, and a challenger that grows
// from packets that do not fit it. One odd packet (an echo) leaves no trace; a clock that jumped, of whichever end,
// brings packets that agree among themselves, and with packets_to_confirm of them the challenger takes over.
#pragma once

#include "fusion/aid_status.h"
#include "fusion/uwb/clock_sync/clock_track.h"

namespace locus::uwb {

class ClockLink {
  public:
    ClockLink(const CrystalModel& crystal, WrappingClock clock) : track_(crystal, clock), challenger_(crystal, clock) {}

    /// none: it went into a clock that is believed. clock_not_synchronised: into one that is not yet.
    Verdict hear(const SyncStamps& stamps);

    /// Forgets all and belongs to somebody else.
    void clear();

    bool is_confirmed() const { return track_.is_confirmed(); }
    const ClockTrack& track() const { return track_; }
    Timestamp last_host() const { return last_host_; }

  private:
    Exclusion reason_for(ClockTrack::Outcome outcome, double innovation_ticks, const SyncStamps& stamps);
    void challenge(const SyncStamps& stamps);

    ClockTrack track_;
    ClockTrack challenger_;
    Timestamp last_host_ = Timestamp::min(); ///< of the last packet, believed or not
};

} // namespace locus::uwb
