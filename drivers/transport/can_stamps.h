// When a CAN frame was received, on CLOCK_MONOTONIC, from what the kernel says of it: its own stamp in wall-clock time,
// and the adapter's stamp in a clock of the adapter's own (protocols.md 6.2).
#pragma once

#include "fusion/time.h"

#include <sys/socket.h>

#include <cstdint>
#include <limits>
#include <optional>

namespace locus {

/// What came beside a frame. Zero stamps mean "none" in the kernel's answer and are left empty here.
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
