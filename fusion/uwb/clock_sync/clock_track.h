// One receiver's clock followed against one transmitter's, from packet to packet. The track remembers its last packets,
// so that a time between two of them is told by both: the last packet before it and the first one after it, whatever
// came later.
#pragma once

#include "fusion/time.h"
#include "fusion/uwb/clock_sync/clock_state.h"
#include "fusion/uwb/ticks.h"

#include <array>
#include <optional>

namespace locus::uwb {

/// A moment as a receiver's clock has it, and, roughly, the host's: that tells how often the receiver's has wrapped.
struct LocalTime {
    std::uint64_t ticks = 0;
    Timestamp host{};
};

struct SyncStamps {
    std::uint64_t sent_ticks_in_transmitter = 0;
    LocalTime received;
};

/// A moment in another clock: a whole number of its ticks, what is left over, and the variance of it all.
struct RemoteTime {
    std::uint64_t ticks = 0;
    double rest_ticks = 0;
    double variance_ticks2 = 0;
};

class ClockTrack {
  public:
    enum class Outcome : std::uint8_t { accepted, repeated, out_of_order, refused };

    struct Answer {
        Outcome outcome = Outcome::refused;
        double innovation_ticks = 0;
        double innovation_sigma_ticks = 0;
    };

    /// Packets that a clock must keep in step with before it is believed. The first one may be the bad one.
    static constexpr std::size_t packets_to_confirm = 4;

    /// In standard deviations. Packets come by the second for weeks: a good one may not look bad.
    static constexpr double gate_in_sigma = 5;

    ClockTrack(const CrystalModel& crystal, WrappingClock clock) : crystal_(crystal), clock_(clock) {}

    bool is_empty() const { return packets_ == 0; }
    bool is_confirmed() const { return packets_ >= packets_to_confirm; }
    Timestamp last_host() const { return newest().host; }

    /// How much faster the receiver's clock runs, as a ratio. Of a track that is not empty.
    double receiver_rate() const { return -newest().state.mean(1) * tick_s; }

    void clear() { packets_ = 0; }
    void start(const SyncStamps& stamps);

    /// Only on a track that is not empty. What is refused changes nothing.
    Answer hear(const SyncStamps& stamps);

    /// What the transmitter's clock shows when the receiver's shows `when`, as if packets took no time from one to the
    /// other. Empty when the receiver's clock and the host's have no time in common: one of them jumped.
    std::optional<RemoteTime> at(const LocalTime& when) const;

    /// Whether a packet is known that was received after `when`.
    bool reaches_beyond(const LocalTime& when) const;

    /// Variance of at() that many seconds after the last packet.
    double variance_after(double dt_s) const { return newest().state.after(dt_s, crystal_).offset_variance(); }

  private:
    struct Packet {
        std::uint64_t received_ticks = 0; ///< the state's moment in the receiver's clock
        std::uint64_t sent_ticks = 0;     ///< and in the transmitter's, which state.offset corrects
        Timestamp host{};
        ClockState state;
        double innovation_ticks = 0;
        double innovation_variance = 1;
    };
    static constexpr std::size_t remembered = 8;

    const Packet& packet(std::size_t age) const { return kept_[(packets_ - 1 - age) % remembered]; }
    const Packet& newest() const { return packet(0); }
    std::size_t kept() const { return packets_ < remembered ? packets_ : remembered; }
    void keep(const Packet& packet);
    std::optional<std::int64_t> since(const Packet& packet, const LocalTime& when) const;
    RemoteTime between(const Packet& before, std::int64_t elapsed_ticks, const Packet* after) const;

    CrystalModel crystal_;
    WrappingClock clock_;
    std::array<Packet, remembered> kept_;
    std::size_t packets_ = 0; ///< accepted since the start
};

} // namespace locus::uwb
