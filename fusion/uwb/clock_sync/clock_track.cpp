#include "fusion/uwb/clock_sync/clock_track.h"

#include <algorithm>
#include <cmath>

namespace locus::uwb {
namespace {

/// A receiver's clock that differs from the host's by more over one interval was started anew. No transport is that
/// uneven.
constexpr double uneven_transport_s = 0.5;
/// Beyond this nothing is known of a clock any more, and the arithmetic need not reach there.
constexpr double longest_silence_s = 1000;

std::int64_t whole(double ticks) { return std::llround(ticks); }

} // namespace

void ClockTrack::keep(const Packet& packet) { kept_[packets_++ % remembered] = packet; }

void ClockTrack::start(const SyncStamps& stamps) {
    packets_ = 0;
    keep({stamps.received.ticks, stamps.sent_ticks_in_transmitter, stamps.received.host, ClockState::first(crystal_)});
}

std::optional<std::int64_t> ClockTrack::since(const Packet& packet, const LocalTime& when) const {
    const double host_s = to_s(when.host - packet.host);
    if (std::abs(host_s) > longest_silence_s) return std::nullopt;
    const std::int64_t ticks = clock_.between_near(when.ticks, packet.received_ticks, whole(host_s / tick_s));
    if (std::abs(static_cast<double>(ticks) * tick_s - host_s) > uneven_transport_s) return std::nullopt;
    return ticks;
}

ClockTrack::Answer ClockTrack::hear(const SyncStamps& stamps) {
    const Packet& last = newest();
    const auto elapsed = since(last, stamps.received);
    if (!elapsed) return {};
    if (*elapsed == 0) return {Outcome::repeated};
    if (*elapsed < 0) return {Outcome::out_of_order};

    Packet next{stamps.received.ticks, stamps.sent_ticks_in_transmitter, stamps.received.host,
                last.state.after(static_cast<double>(*elapsed) * tick_s, crystal_)};
    const std::int64_t offset = whole(next.state.offset_ticks());
    const std::uint64_t expected_ticks = last.sent_ticks + static_cast<std::uint64_t>(*elapsed + offset);
    next.state.mean(0) -= static_cast<double>(offset);
    next.innovation_ticks =
        static_cast<double>(clock_.between(next.sent_ticks, expected_ticks)) - next.state.offset_ticks();
    next.innovation_variance = next.state.offset_variance() + crystal_.arrival_variance;
    const double sigma_ticks = std::sqrt(next.innovation_variance);
    Answer answer{Outcome::refused, next.innovation_ticks, sigma_ticks};
    if (!(std::abs(next.innovation_ticks) <= gate_in_sigma * sigma_ticks)) return answer;

    next.state.mean(0) = -next.innovation_ticks; // from here on against this packet's own stamp
    next.state.update(next.innovation_ticks, crystal_.arrival_variance);
    keep(next);
    answer.outcome = Outcome::accepted;
    return answer;
}

bool ClockTrack::reaches_beyond(const LocalTime& when) const {
    if (is_empty()) return false;
    const auto elapsed = since(newest(), when);
    return elapsed && *elapsed < 0;
}

std::optional<RemoteTime> ClockTrack::at(const LocalTime& when) const {
    for (std::size_t age = 0; age < kept(); ++age) {
        const auto elapsed = since(packet(age), when);
        if (!elapsed) return std::nullopt;
        const bool oldest = age + 1 == kept();
        if (*elapsed >= 0 || oldest)
            return between(packet(age), *elapsed, age > 0 && *elapsed >= 0 ? &packet(age - 1) : nullptr);
    }
    return std::nullopt;
}

/// The state carried on from the packet before; and then what the packet after it, which is known to have come by so
/// much late or early, says of the moment between them: fixed-interval smoothing over one interval (Rauch, Tung,
/// Striebel 1965), for the offset alone.
RemoteTime ClockTrack::between(const Packet& before, std::int64_t elapsed_ticks, const Packet* after) const {
    const ClockState state = before.state.after(static_cast<double>(elapsed_ticks) * tick_s, crystal_);
    double offset = state.offset_ticks(), variance = state.offset_variance();
    if (after) {
        const auto interval = clock_.between_near(after->received_ticks, before.received_ticks,
                                                  whole(to_s(after->host - before.host) / tick_s));
        const double covariance =
            state.covariance_with_later_offset(static_cast<double>(interval - elapsed_ticks) * tick_s);
        offset += covariance / after->innovation_variance * after->innovation_ticks;
        variance -= covariance * covariance / after->innovation_variance;
    }
    const std::int64_t whole_offset = whole(offset);
    return {before.sent_ticks + static_cast<std::uint64_t>(elapsed_ticks + whole_offset),
            offset - static_cast<double>(whole_offset), std::max(variance, 0.0)};
}

} // namespace locus::uwb
