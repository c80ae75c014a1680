// DeviceClock: the time at which a device took its samples, told by the device's own counter and brought to the host's
// clock. The stamps of reception carry all the jitter of the transport; the device's crystal carries none, only an
// unknown offset and a slow drift. A packet can come late but never early, so the lowest of (host - device) over some
// time lie on a line, and this line is the clock:
//
//     received = offset + (1 + drift) * device time + delay,  delay >= 0
//
// The line is the one that lies under all points and closest to them in sum: the edge of the lower convex hull above
// the points' mean (Moon, Skelly, Towsley, "Estimation and removal of clock skew from network delay measurements",
// INFOCOM 1999, sec. III; by way of the hull: Zhang, Liu, Xia, "Clock synchronization algorithms for network
// measurements", INFOCOM 2002, sec. III). What is common to all delays cannot be seen: the setting delay_s of the input
// takes it off.
#pragma once

#include "fusion/time.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace locus {

class DeviceClock {
  public:
    static constexpr std::size_t buckets = 32;
    static constexpr double bucket_s = 2; ///< the window is about a minute: temperature moves a crystal more slowly

    /// What no transport does, so that the counter must have jumped.
    struct Limits {
        /// Crystals are sold with 20 to 100 ppm over temperature, two clocks differ by twice that. Ceramic resonators
        /// have up to 5000 ppm (Murata CSTCE): those are not followed by the line, but by beginning anew.
        double largest_drift = 500e-6;
        /// One step off what the host's clock says by more: the counter began again.
        double restart_s = 1;
        /// Below the line by more: the counter jumped ahead. Three times what USB serial converters hold back (16 ms,
        /// the latency timer of FTDI AN232B-04).
        double jump_s = 0.05;
        /// Above the line by more than jump_s for so long: the counter fell back. After a stall of the host the last of
        /// what had waited is on time again, so packets that are all late do not come from a stall.
        Duration patience = std::chrono::milliseconds{500};
    };

    /// `tick_s` is the nominal time from one count to the next; the counter wraps around after 2^bits (1 to 64) counts.
    DeviceClock(double tick_s, unsigned bits) : DeviceClock{tick_s, bits, Limits{}} {}
    /// For devices whose samples are late by more, or come more seldom.
    DeviceClock(double tick_s, unsigned bits, const Limits& limits) : tick_s_{tick_s}, bits_{bits}, limits_{limits} {}

    /// When the device's counter stood at `count`, for a packet that was received at `received`: not after any
    /// reception until now, and not before what was said for an earlier packet since the estimate last began.
    Timestamp host_time(std::uint64_t count, Timestamp received);

    /// Forgets all: the device was opened again.
    void reset() { begun_ = false; }

    double drift() const { return drift_; }
    /// Times that the estimate began, over resets and restarts.
    std::uint64_t beginnings() const { return beginnings_; }

  private:
    struct Point {
        double device_s; ///< since the estimate began
        double excess_s; ///< host time since the estimate began, less device time
    };

    /// Points in order of device time; as many as buckets, the oldest is overwritten.
    struct Window {
        std::array<Point, buckets> points{};
        std::size_t first = 0, size = 0;

        const Point& operator[](std::size_t i) const { return points[(first + i) % buckets]; }
        void push(const Point& point);
        void drop_before(double device_s);
    };

    std::optional<std::int64_t> ticks_since_last(std::uint64_t count, Timestamp received) const;
    Timestamp begin(std::uint64_t count, Timestamp received);
    bool is_jump(double above_s, Timestamp received);
    void take(const Point& point);
    void close_bucket(double device_s);
    void fit();
    double line_at(double device_s) const { return offset_s_ + drift_ * device_s; }

    double tick_s_;
    unsigned bits_;
    Limits limits_;

    bool begun_ = false;
    std::uint64_t beginnings_ = 0;
    Timestamp epoch_{};         ///< host time of the first packet
    Timestamp last_received_{}; ///< the latest
    Timestamp last_said_{};
    std::optional<Timestamp> late_since_; ///< all since then lay above the line by more than jump_s
    std::uint64_t last_count_ = 0;
    std::int64_t ticks_ = 0; ///< since the estimate began

    Window window_;
    Point lowest_{};           ///< of the open bucket, above the line as it stands
    double least_above_s_ = 0; ///< by so much
    double bucket_end_s_ = 0;  ///< device time
    double offset_s_ = 0, drift_ = 0;
};

} // namespace locus
