// Time as the whole house speaks it: nanoseconds of CLOCK_MONOTONIC on this host.
#pragma once

#include <chrono>
#include <cstdint>

namespace locus {

/// Tag of the one time base. It has no now(): fusion/ reads no clock, time comes in with the measurements.
struct Monotonic {
    using rep = std::int64_t;
    using period = std::nano;
    using duration = std::chrono::nanoseconds;
    static constexpr bool is_steady = true;
};

using Duration = std::chrono::nanoseconds;
/// When a sample was taken (never when it was processed), ns of CLOCK_MONOTONIC.
using Timestamp = std::chrono::time_point<Monotonic, Duration>;

constexpr Timestamp timestamp_from_ns(std::int64_t monotonic_ns) { return Timestamp{Duration{monotonic_ns}}; }
constexpr std::int64_t to_ns(Timestamp time) { return time.time_since_epoch().count(); }
constexpr double to_s(Duration duration) { return std::chrono::duration<double>(duration).count(); }
constexpr double to_s(Timestamp time) { return to_s(time.time_since_epoch()); }

/// Nearest nanosecond; the caller has checked that |seconds| < 9e9.
constexpr Duration duration_from_s(double seconds) {
    return Duration{static_cast<std::int64_t>(seconds * 1e9 + (seconds < 0 ? -0.5 : 0.5))};
}
constexpr Timestamp timestamp_from_s(double monotonic_s) { return Timestamp{duration_from_s(monotonic_s)}; }

} // namespace locus
