// What a buffer of the driver says beside its bytes: when it was exposed, and how many came to nobody before it.
#pragma once

#include "drivers/camera/v4l2_settings.h"
#include "fusion/time.h"

#include <linux/videodev2.h>

#include <cstdint>
#include <optional>

namespace locus::camera {

/// Middle of the exposure by the driver's stamp; empty when that is not of CLOCK_MONOTONIC (kernel documentation,
/// "Buffer exchange: timestamp flags").
inline std::optional<Timestamp> capture_time(const v4l2_buffer& buffer, const V4l2Settings& settings) {
    if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) != V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) return std::nullopt;
    const bool is_start = (buffer.flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
    const Timestamp stamp{std::chrono::seconds{buffer.timestamp.tv_sec} +
                          std::chrono::microseconds{buffer.timestamp.tv_usec}};
    const double half_exposure_s = 0.5 * settings.exposure_s;
    return stamp + duration_from_s((is_start ? half_exposure_s : -half_exposure_s) - settings.delay_s);
}

/// The driver's 32-bit numbers made 64-bit ones that rise over wraps and re-opening.
class FrameCounter {
  public:
    /// Frames between the last one and this; a driver that counts nothing or starts anew has lost none.
    std::uint64_t take(std::uint32_t sequence) {
        const std::uint32_t step = last_ ? sequence - *last_ : 1;
        last_ = sequence;
        const bool is_sane = step > 0 && step < implausible_step;
        count_ += is_sane ? step : 1;
        return is_sane ? step - 1 : 0;
    }
    void restart() { last_.reset(); }
    std::uint64_t count() const { return count_; }

  private:
    static constexpr std::uint32_t implausible_step = 100'000;
    std::optional<std::uint32_t> last_;
    std::uint64_t count_ = 0;
};

} // namespace locus::camera
