// Lower envelope of (host - device), and what to do when the counter wraps, jumps or begins again.
#include "drivers/device_clock.h"

#include "drivers/wire/bytes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace locus {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

} // namespace

void DeviceClock::Window::push(const Point& point) {
    points[(first + size) % buckets] = point;
    if (size < buckets)
        ++size;
    else
        first = (first + 1) % buckets;
}

void DeviceClock::Window::drop_before(double device_s) {
    while (size > 0 && points[first].device_s < device_s) first = (first + 1) % buckets, --size;
}

Timestamp DeviceClock::host_time(std::uint64_t count, Timestamp received) {
    // A stamp that is made from the end of a chunk and the wire's nominal speed can lie before its predecessor's.
    if (begun_) received = std::max(received, last_received_);
    const auto ticks = begun_ ? ticks_since_last(count, received) : std::nullopt;
    if (!ticks) return begin(count, received);
    ticks_ += *ticks;
    last_count_ = count;
    last_received_ = received;
    const double device_s = static_cast<double>(ticks_) * tick_s_;
    const Point point{device_s, to_s(received - epoch_) - device_s};
    if (is_jump(point.excess_s - line_at(device_s), received)) return begin(count, received);
    if (device_s >= bucket_end_s_) close_bucket(device_s);
    take(point);
    return last_said_ = std::clamp(epoch_ + duration_from_s(device_s + line_at(device_s)), last_said_, received);
}

/// The step of the counter that agrees best with the host's clock; none when it agrees too badly, or goes back.
std::optional<std::int64_t> DeviceClock::ticks_since_last(std::uint64_t count, Timestamp received) const {
    const double elapsed_s = to_s(received - last_received_);
    const double expected = elapsed_s / tick_s_;
    if (expected > 1e18) return std::nullopt;
    const auto nearest = static_cast<std::int64_t>(expected);
    const std::uint64_t difference = count - last_count_ - static_cast<std::uint64_t>(nearest);
    const std::int64_t off = wire::sign_extended(difference, bits_);
    const double ahead_s = static_cast<double>(off) * tick_s_;
    if (std::abs(ahead_s) > limits_.restart_s + limits_.largest_drift * elapsed_s) return std::nullopt;
    return nearest + off < 0 ? std::nullopt : std::optional{nearest + off};
}

Timestamp DeviceClock::begin(std::uint64_t count, Timestamp received) {
    begun_ = true;
    ++beginnings_;
    epoch_ = last_received_ = last_said_ = received;
    late_since_.reset();
    last_count_ = count;
    ticks_ = 0;
    window_.size = 0;
    offset_s_ = drift_ = 0;
    lowest_ = {0, 0};
    least_above_s_ = 0;
    bucket_end_s_ = bucket_s;
    return received;
}

bool DeviceClock::is_jump(double above_s, Timestamp received) {
    if (above_s <= limits_.jump_s)
        late_since_.reset();
    else if (!late_since_)
        late_since_ = received;
    return above_s < -limits_.jump_s || (late_since_ && received - *late_since_ > limits_.patience);
}

/// The lowest of its bucket is kept; what lies below the line moves it down at once.
void DeviceClock::take(const Point& point) {
    const double above_s = point.excess_s - line_at(point.device_s);
    if (above_s < least_above_s_) {
        lowest_ = point;
        least_above_s_ = std::max(above_s, 0.0);
    }
    offset_s_ += std::min(above_s, 0.0);
}

void DeviceClock::close_bucket(double device_s) {
    window_.push(lowest_);
    window_.drop_before(device_s - buckets * bucket_s);
    if (window_.size > 0) fit();
    bucket_end_s_ = device_s + bucket_s;
    least_above_s_ = infinity;
}

/// Among the lines under all points, the one that is highest over their mean has the least sum of distances.
void DeviceClock::fit() {
    std::array<Point, buckets> hull{};
    std::size_t size = 0;
    double mean_s = 0;
    const auto slope = [](const Point& a, const Point& b) {
        return (b.excess_s - a.excess_s) / (b.device_s - a.device_s);
    };
    for (std::size_t i = 0; i < window_.size; ++i) {
        const Point& point = window_[i];
        mean_s += point.device_s / static_cast<double>(window_.size);
        while (size >= 2 && slope(hull[size - 2], hull[size - 1]) >= slope(hull[size - 1], point)) --size;
        hull[size++] = point;
    }
    for (std::size_t i = 1; i < size; ++i)
        if (hull[i].device_s >= mean_s || i + 1 == size) {
            drift_ = std::clamp(slope(hull[i - 1], hull[i]), -limits_.largest_drift, limits_.largest_drift);
            break;
        }
    offset_s_ = infinity;
    for (const Point& point : std::span{hull}.first(size))
        offset_s_ = std::min(offset_s_, point.excess_s - drift_ * point.device_s);
}

} // namespace locus
