// Satellites, one by one: which are taken, what becomes of their ranges and rates, when the receiver sets its clock,
// and when they say that the filter is in the wrong place.
#include "fusion/estimators/gnss_ins.h"
#include "fusion/units.h"

#include <cmath>

namespace locus {
namespace {

/// Receivers set their clocks by milliseconds (300 km); no pseudorange is wrong by as much as a kilometre otherwise.
constexpr double least_clock_jump_m = 1000, jumps_agree_m = 100;
/// Observations over which the share of refused ones is taken.
constexpr double satellite_memory = 500;

std::size_t gate_of(const SatelliteRange& range) {
    return (range.constellation % std::size_t{8}) * 64 + range.satellite % std::size_t{64};
}

} // namespace

Exclusion GnssIns::refusal(const SatelliteRange& range) const noexcept {
    if (settings().coupling == "loose") return Exclusion::disabled;
    if (double{range.carrier_to_noise_dbhz} < settings().least_carrier_to_noise_dbhz) return Exclusion::too_weak;
    if (!started_) return Exclusion::none;
    const double least = std::sin(settings().least_elevation_deg * rad_per_deg);
    return observations_->elevation_sine(track_, range) < least ? Exclusion::too_low : Exclusion::none;
}

Verdict GnssIns::take(const SatelliteRange& range, Timestamp time) noexcept {
    const Exclusion reason = refusal(range);
    if (reason != Exclusion::none) return {reason};
    satellites_heard_ = time;
    start_.keep(range, time);
    if (!started_) {
        const auto found = start_.solve(*observations_, time);
        return found ? start(*found, time) : Verdict{Exclusion::waiting_for_start};
    }
    move_to(time);
    const GnssInsScalar code = observations_->pseudorange(track_, range);
    if (clock_jumped(range, code)) return {Exclusion::clock_jumped};
    Verdict verdict = weigh(Aid::code, code, code_gates_[gate_of(range)]);
    const Verdict rate = take_rate(range, rate_gates_[gate_of(range)]);
    note(verdict.reason == Exclusion::none ? verdict : rate, time, satellite_memory);
    verdict.carrier = hear_carrier(range, time);
    start_again_if_lost(time);
    return verdict;
}

Verdict GnssIns::take_rate(const SatelliteRange& range, filter::Gate& gate) noexcept {
    if (!std::isfinite(range.range_rate_mps)) return {Exclusion::not_finite};
    return weigh(Aid::rate, observations_->range_rate(track_, range), gate);
}

/// One satellite that is off by kilometres is wrong; two in a row that are off by the same are right.
bool GnssIns::clock_jumped(const SatelliteRange& range, const GnssInsScalar& code) noexcept {
    if (std::abs(code.innovation) < least_clock_jump_m) return false;
    carriers_.forget();
    const bool confirmed =
        range.satellite != clock_jump_by_ && std::abs(code.innovation - clock_jump_m_) < jumps_agree_m;
    clock_jump_m_ = code.innovation;
    clock_jump_by_ = range.satellite;
    if (!confirmed) return true;
    track_.shift_clock(code.innovation, jumps_agree_m);
    clock_jump_m_ = 0;
    return true;
}

/// Most satellites refused may mean a street canyon or a filter in the wrong place: it moves only when they agree on
/// another one.
void GnssIns::start_again_if_lost(Timestamp time) noexcept {
    if (refused_share_ < lost_share) return;
    if (const auto found = start_.solve(*observations_, time)) start(*found, time);
}

} // namespace locus
