#include "fusion/gnss/receivers.h"

#include "fusion/gnss/satellite_range.h"
#include "fusion/gnss/signals.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace locus::gnss {
namespace {

/// A receiver's clock may be set back; what is older than its last epoch by less is late.
constexpr double late_s = 10;
/// For so long a receiver counts as one that tells fixes itself.
constexpr Duration fixes_go_on = duration_from_s(2);
/// For so long the last position holds for the air: at the speed of a car it is within 100 km.
constexpr double position_holds_s = 3600;

bool is_possible_time(const GnssRaw& raw) {
    return raw.receiver_time_s_in_gps_week >= 0 && raw.receiver_time_s_in_gps_week <= week_s;
}

bool is_late(const ReceiverEpoch& epoch, const GpsTime& time) {
    const double behind_s = epoch.time - time;
    return epoch.begun && behind_s < late_s && (behind_s > 0 || (behind_s == 0 && epoch.signals.empty()));
}

bool same_satellite(const GnssRaw& a, const GnssRaw& b) {
    return a.constellation == b.constellation && a.satellite == b.satellite;
}

std::optional<Eigen::Vector3d> origin_of(const Site& site) {
    if (!site.origin) return std::nullopt;
    return ecef_m({site.origin->latitude_deg, site.origin->longitude_deg, site.origin->height_ellipsoid_m});
}

} // namespace

Receivers::Receivers(const Site& site, const GnssSettings& settings, Duration longest_wait)
    : settings_{settings}, gather_{std::min(duration_from_s(settings.gather_s), longest_wait)},
      site_ecef_m_{origin_of(site)}, ephemerides_{settings}, bases_{settings}, solver_{settings} {
    receivers_.resize(static_cast<std::size_t>(settings.max_receivers));
    for (ReceiverEpoch& one : receivers_) one.signals.reserve(ReceiverEpoch::most_signals);
    sights_.reserve(ReceiverEpoch::most_signals);
}

void Receivers::hear(const GnssNavigation& words) noexcept {
    if (now_) ephemerides_.hear(words, *now_);
}

void Receivers::hear(const GnssFix& fix, Timestamp time) noexcept {
    if (fix.fix_type == gnss_fix_type::none) return;
    for (std::size_t i = 0; i < receiver_count_; ++i)
        if (receivers_[i].tag == fix.tag) receivers_[i].told_fix = time;
}

Exclusion Receivers::hear(const Measurement& measurement, const AidBook::Record& record, Timestamp arrival,
                          Output& output) noexcept {
    const GnssRaw& raw = *std::get_if<GnssRaw>(&measurement.observation);
    if (!is_possible_time(raw)) return Exclusion::impossible_time;
    ReceiverEpoch* epoch = receiver_of(raw.tag, measurement.input);
    if (epoch == nullptr) return Exclusion::unknown_target;
    const GpsTime time = time_of(raw);
    if (is_late(*epoch, time)) return Exclusion::late;
    if (time != epoch->time) deal(*epoch, output);
    if (epoch->signals.size() == ReceiverEpoch::most_signals) return Exclusion::window_full;
    if (epoch->signals.empty()) epoch->first_arrival = arrival;
    epoch->time = time;
    epoch->begun = true;
    epoch->signals.push_back({measurement, record});
    now_ = time;
    return Exclusion::none;
}

ReceiverEpoch* Receivers::receiver_of(Address tag, std::uint16_t input) noexcept {
    const auto end = receivers_.begin() + static_cast<std::ptrdiff_t>(receiver_count_);
    const auto found = std::find_if(receivers_.begin(), end,
                                    [&](const ReceiverEpoch& one) { return one.tag == tag && one.input == input; });
    if (found != end) return &*found;
    if (receiver_count_ == receivers_.size()) return nullptr;
    ReceiverEpoch& opened = receivers_[receiver_count_++];
    opened.tag = tag;
    opened.input = input;
    return &opened;
}

void Receivers::run(Timestamp tick, Output& output) noexcept {
    for (std::size_t i = 0; i < receiver_count_; ++i)
        if (tick >= receivers_[i].first_arrival + gather_) deal(receivers_[i], output);
}

void Receivers::deal(ReceiverEpoch& epoch, Output& output) noexcept {
    if (epoch.signals.empty()) return;
    sight(epoch);
    const auto point = locate(epoch);
    const Measurement first = epoch.signals.front().measurement;
    for (const HeardSignal& signal : epoch.signals) give(signal, point.has_value(), output);
    epoch.signals.clear();
    if (point && settings_.own_fix && !tells_fixes(epoch, first.time))
        output.tell({first.time, first.sequence, first.input, own_fix(epoch.tag, *point)});
}

bool Receivers::tells_fixes(const ReceiverEpoch& epoch, Timestamp time) const noexcept {
    return epoch.told_fix && time - *epoch.told_fix <= fixes_go_on;
}

/// In the order of satellites, so that nothing hangs on the order in which the signals came.
void Receivers::sight(ReceiverEpoch& epoch) noexcept {
    std::ranges::sort(epoch.signals, {}, [](const HeardSignal& s) {
        return std::tuple{s.raw().constellation, s.raw().satellite, s.raw().signal, s.measurement.sequence};
    });
    sights_.clear();
    bases_.prepare(epoch.time, epoch.position_ecef_m ? epoch.position_ecef_m : site_ecef_m_, ephemerides_);
    const GnssRaw* accepted = nullptr;
    for (HeardSignal& signal : epoch.signals) {
        signal.sight = sights_.size();
        signal.reason = sight(signal.raw(), accepted);
        if (signal.reason == Exclusion::none) accepted = &signal.raw();
    }
}

Exclusion Receivers::sight(const GnssRaw& raw, const GnssRaw* accepted) noexcept {
    if (!is_used_signal(raw.constellation, raw.signal)) return Exclusion::other_signal;
    if (accepted && same_satellite(*accepted, raw))
        return accepted->signal == raw.signal ? Exclusion::duplicate : Exclusion::other_signal;
    if (!is_possible_pseudorange(raw.pseudorange_m)) return Exclusion::impossible_range;
    if (double{raw.carrier_to_noise_dbhz} < settings_.min_carrier_to_noise_dbhz) return Exclusion::too_weak;
    const auto [ephemeris, reason] = ephemerides_.find(raw.constellation, raw.satellite, time_of(raw));
    if (ephemeris == nullptr) return reason;
    const auto sight = sight_of(raw, *ephemeris);
    if (!sight) return Exclusion::impossible_orbit;
    sights_.push_back({*sight, bases_.find(raw.constellation, raw.satellite)});
    return Exclusion::none;
}

std::optional<SinglePoint> Receivers::locate(ReceiverEpoch& epoch) noexcept {
    const Sky sky{epoch.time, ephemerides_.ionosphere()};
    auto point = solver_.solve(sights_, sky, epoch.position_ecef_m.value_or(Eigen::Vector3d::Zero()));
    if (point) {
        epoch.position_ecef_m = point->position_ecef_m;
        epoch.position_time = epoch.time;
    } else
        observe_from_last(epoch, sky);
    return point;
}

/// Too few for a position still tell a filter something. What the attempt left out is in again.
void Receivers::observe_from_last(const ReceiverEpoch& epoch, const Sky& sky) noexcept {
    const bool holds = epoch.position_ecef_m && std::abs(epoch.time - epoch.position_time) < position_holds_s;
    const auto& from_ecef_m = holds ? epoch.position_ecef_m : site_ecef_m_;
    for (SightFrom& s : sights_) s.reason = from_ecef_m ? Exclusion::none : Exclusion::no_position_yet;
    if (from_ecef_m) solver_.observer().observe(sights_, sky, *from_ecef_m);
}

void Receivers::give(const HeardSignal& signal, bool located, Output& output) const noexcept {
    const auto& [measurement, record, before, index] = signal;
    const Exclusion reason = before == Exclusion::none ? sights_[index].reason : before;
    if (reason != Exclusion::none) return output.judge(measurement, record, reason);
    if (!settings_.satellite_ranges)
        return output.judge(measurement, record, located ? Exclusion::none : Exclusion::not_given_out);
    output.take(
        {measurement.time, measurement.sequence, measurement.input, satellite_range(signal.raw(), sights_[index])},
        record);
}

} // namespace locus::gnss
