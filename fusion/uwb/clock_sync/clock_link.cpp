#include "fusion/uwb/clock_sync/clock_link.h"

#include <cmath>

namespace locus::uwb {
namespace {

/// No echo is later than this, a microsecond: then a clock jumped.
constexpr double longest_echo_ticks = 1e-6 / tick_s;

} // namespace

void ClockLink::clear() {
    track_.clear();
    challenger_.clear();
    last_host_ = Timestamp::min();
}

Verdict ClockLink::hear(const SyncStamps& stamps) {
    last_host_ = stamps.received.host;
    if (track_.is_empty()) {
        track_.start(stamps);
        return {Exclusion::clock_not_synchronised};
    }
    const ClockTrack::Answer answer = track_.hear(stamps);
    Verdict verdict{reason_for(answer.outcome, answer.innovation_ticks, stamps)};
    if (answer.innovation_sigma_ticks == 0) return verdict;
    verdict.innovation = static_cast<float>(answer.innovation_ticks * tick_m);
    verdict.innovation_sigma = static_cast<float>(answer.innovation_sigma_ticks * tick_m);
    verdict.test_ratio = static_cast<float>(std::abs(answer.innovation_ticks) /
                                            (ClockTrack::gate_in_sigma * answer.innovation_sigma_ticks));
    return verdict;
}

Exclusion ClockLink::reason_for(ClockTrack::Outcome outcome, double innovation_ticks, const SyncStamps& stamps) {
    switch (outcome) {
    case ClockTrack::Outcome::accepted:
        challenger_.clear();
        return track_.is_confirmed() ? Exclusion::none : Exclusion::clock_not_synchronised;
    case ClockTrack::Outcome::repeated:
        return Exclusion::duplicate;
    case ClockTrack::Outcome::out_of_order:
        return Exclusion::late;
    case ClockTrack::Outcome::refused:
        break;
    }
    if (!track_.is_confirmed()) {
        track_.start(stamps); // which of the two is the bad one is not known
        return Exclusion::clock_not_synchronised;
    }
    challenge(stamps);
    const bool echo = innovation_ticks != 0 && std::abs(innovation_ticks) < longest_echo_ticks;
    return echo ? Exclusion::innovation_too_large : Exclusion::clock_jumped;
}

void ClockLink::challenge(const SyncStamps& stamps) {
    const bool fits = !challenger_.is_empty() && challenger_.hear(stamps).outcome == ClockTrack::Outcome::accepted;
    if (!fits) challenger_.start(stamps);
    if (!challenger_.is_confirmed()) return;
    track_ = challenger_;
    challenger_.clear();
}

} // namespace locus::uwb
