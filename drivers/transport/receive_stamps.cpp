#include "drivers/transport/receive_stamps.h"

#include "drivers/clock.h"

#include <linux/errqueue.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace locus {
namespace {

/// A stamp further than that from the time of reading was spoilt by somebody setting the clock.
constexpr Duration implausible_age = std::chrono::seconds{5};
constexpr Duration window = std::chrono::seconds{1};
/// No frame waits that long in an adapter: the adapter's clock was restarted or has wrapped.
constexpr Duration implausible_step = std::chrono::milliseconds{100};

std::optional<Duration> from_timespec(const timespec& time) {
    const bool sane = time.tv_sec >= 0 && time.tv_sec < 4'000'000'000 && (time.tv_sec != 0 || time.tv_nsec != 0);
    if (!sane) return std::nullopt;
    return std::chrono::seconds{time.tv_sec} + Duration{time.tv_nsec};
}

template <class Content>
Content content_of(const cmsghdr& header) {
    Content content{};
    if (header.cmsg_len >= CMSG_LEN(sizeof content)) std::memcpy(&content, CMSG_DATA(&header), sizeof content);
    return content;
}

} // namespace

ControlData read_control(const msghdr& message) {
    ControlData data;
    msghdr copy = message; // CMSG_NXTHDR wants it writable
    for (cmsghdr* header = CMSG_FIRSTHDR(&copy); header; header = CMSG_NXTHDR(&copy, header)) {
        if (header->cmsg_level != SOL_SOCKET) continue;
        if (header->cmsg_type == SCM_TIMESTAMPING) {
            const auto stamps = content_of<scm_timestamping>(*header);
            data.kernel_realtime = from_timespec(stamps.ts[0]);
            data.adapter = from_timespec(stamps.ts[2]);
        } else if (header->cmsg_type == SO_RXQ_OVFL) {
            data.dropped = content_of<std::uint32_t>(*header);
        }
    }
    return data;
}

Duration realtime_offset() {
    const Timestamp before = monotonic_now();
    const Timestamp realtime = read_clock(CLOCK_REALTIME);
    const Timestamp after = monotonic_now();
    return realtime - (before + (after - before) / 2);
}

Timestamp kernel_time(const ControlData& control, Duration realtime_offset, Timestamp now) {
    if (!control.kernel_realtime) return now;
    const Timestamp time{*control.kernel_realtime - realtime_offset};
    return time > now || time < now - implausible_age ? now : time;
}

Timestamp AdapterClock::to_monotonic(Duration adapter, Timestamp kernel) {
    const Duration difference = kernel.time_since_epoch() - adapter;
    const Duration least = std::min(least_now_, least_before_);
    if (least == none || std::chrono::abs(difference - least) > implausible_step) {
        least_now_ = least_before_ = difference;
        second_ends_ = kernel + window;
    } else if (kernel >= second_ends_) {
        least_before_ = std::exchange(least_now_, difference);
        second_ends_ = kernel + window;
    }
    least_now_ = std::min(least_now_, difference);
    return Timestamp{adapter + std::min(least_now_, least_before_)};
}

} // namespace locus
