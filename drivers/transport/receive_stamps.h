// When a frame or datagram was received, on CLOCK_MONOTONIC, from what the kernel says of it: its own stamp in
// wall-clock time, and a CAN adapter's stamp in a clock of the adapter's own (protocols.md 6.2). And how many it
// dropped.
#pragma once

#include "fusion/time.h"

#include <sys/socket.h>

#include <cstdint>
#include <limits>
#include <optional>

namespace locus {

/// What came beside a frame or datagram. Zero stamps mean "none" in the kernel's answer and are left empty here.
struct ControlData {
    std::optional<Duration> kernel_realtime;
    std::optional<Duration> adapter;
    std::optional<std::uint32_t> dropped; ///< by the kernel since the socket was opened; wraps
};

/// Reads the control messages of one received message (SCM_TIMESTAMPING, SO_RXQ_OVFL).
ControlData read_control(const msghdr& message);

/// CLOCK_REALTIME minus CLOCK_MONOTONIC, sampled now. It jumps when somebody sets the clock; a stamp is therefore
/// converted with a sample taken right after it was read.
Duration realtime_offset();

/// The kernel's stamp on CLOCK_MONOTONIC, or `now`, the time of reading, where there is none, or where somebody who set
/// the clock in between spoilt it.
Timestamp kernel_time(const ControlData& control, Duration realtime_offset, Timestamp now);

/// The kernel counts drops of one socket in a number that wraps; here over all sockets that a transport opened.
class KernelDrops {
  public:
    /// A new socket counts from zero.
    void reset() { here_ = 0; }
    void take(const ControlData& control) {
        const std::uint32_t here = control.dropped.value_or(here_);
        total_ += here - here_;
        here_ = here;
    }
    std::uint64_t total() const { return total_; }

  private:
    std::uint32_t here_ = 0;
    std::uint64_t total_ = 0;
};

/// The adapter's clock on ours. Adapter and kernel stamps of one frame differ by a constant, the adapter's epoch, and
/// by the delay until the kernel saw the frame, which is never negative: so the least difference of the last seconds is
/// the constant plus the least delay. Kept over one to two seconds, so the drift of a 50 ppm crystal costs 0.1 ms at
/// most.
class AdapterClock {
  public:
    /// `kernel`: the kernel's stamp of the same frame. The result is never later than that.
    Timestamp to_monotonic(Duration adapter, Timestamp kernel);

  private:
    static constexpr Duration none{std::numeric_limits<std::int64_t>::max()};

    Duration least_now_ = none;    ///< of the running second
    Duration least_before_ = none; ///< of the second before
    Timestamp second_ends_{};
};

} // namespace locus
