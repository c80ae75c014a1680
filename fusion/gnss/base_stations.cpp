#include "fusion/gnss/base_stations.h"

#include "fusion/filter/gate.h"
#include "fusion/geometry/vector.h"
#include "fusion/gnss/base_range.h"
#include "fusion/gnss/least_squares.h"

#include <algorithm>
#include <cmath>

namespace locus::gnss {
namespace {

using ClockEquations = LeastSquares<clock_count>;

/// A base's clock may be set back; what is older than its last pseudorange by less is late.
constexpr double base_late_s = 10;

ClockEquations::Row clock_row(const SightFrom& s) {
    return ClockEquations::Row::Unit(static_cast<Eigen::Index>(base_clock(s)));
}

double beyond_model_m(const SightFrom& s, const Eigen::Vector3d& antenna_ecef_m) {
    return s.range_m - (s.satellite_ecef_m - antenna_ecef_m).norm();
}

} // namespace

BaseStations::BaseStations(const GnssSettings& settings)
    : settings_{settings}, observer_{settings}, normal_quantile_{filter::gate_in_sigma(2 * settings.false_alarm)} {
    sights_.reserve(satellite_places::all);
    places_.reserve(satellite_places::all);
}

Exclusion BaseStations::judge(const GnssBaseRange& range) const noexcept {
    if (!(range.time_s_in_gps_week >= 0 && range.time_s_in_gps_week <= week_s)) return Exclusion::impossible_time;
    if (!vector(range.antenna_ecef_m).allFinite()) return Exclusion::base_without_place;
    if (!is_used_signal(range.constellation, range.signal)) return Exclusion::other_signal;
    if (!is_possible_pseudorange(range.pseudorange_m)) return Exclusion::impossible_range;
    if (double{range.carrier_to_noise_dbhz} < settings_.min_carrier_to_noise_dbhz) return Exclusion::too_weak;
    const bool known = satellite_place(range.constellation, range.satellite) != satellite_places::nowhere;
    return known ? Exclusion::none : Exclusion::no_ephemeris;
}

Exclusion BaseStations::hear(const GnssBaseRange& range, std::uint16_t input) noexcept {
    const Exclusion reason = judge(range);
    if (reason != Exclusion::none) return reason;
    Base& base = base_of(range, input);
    GnssBaseRange& last = base.ranges[satellite_place(range.constellation, range.satellite)];
    const double later_s = since_s(last.time_s_in_gps_week, range.time_s_in_gps_week);
    if (is_heard(last) && later_s == 0) return Exclusion::duplicate;
    if (is_heard(last) && later_s < 0 && later_s > -base_late_s) return Exclusion::late;
    last = range;
    base.newest_s[base_clock(range.constellation)] = range.time_s_in_gps_week;
    const bool forgotten = base.asked_s == never || std::abs(since_s(base.asked_s, range.time_s_in_gps_week)) >
                                                        std::max(1.0, settings_.max_correction_age_s);
    return forgotten ? Exclusion::nothing_to_correct : base.outcome;
}

/// One that says that it stands elsewhere begins anew: a virtual one that was moved, or a survey that came to its end.
BaseStations::Base& BaseStations::base_of(const GnssBaseRange& range, std::uint16_t input) noexcept {
    const auto is_it = [&](const Base& base) {
        return base.heard > 0 && base.station == range.base && base.input == input;
    };
    auto found = std::ranges::find_if(bases_, is_it);
    if (found == bases_.end()) found = std::ranges::min_element(bases_, {}, &Base::heard);
    Base& base = *found;
    if (!is_it(base) || base.antenna_ecef_m != range.antenna_ecef_m) {
        base = {};
        base.newest_s.fill(never);
        base.station = range.base;
        base.input = input;
        base.antenna_ecef_m = range.antenna_ecef_m;
    }
    base.heard = ++heard_;
    return base;
}

double BaseStations::age_s(const Base& base, const GpsTime& time) const noexcept {
    double least_s = std::numeric_limits<double>::infinity();
    for (const double newest_s : base.newest_s)
        if (newest_s != never) least_s = std::min(least_s, std::abs(since_s(newest_s, time.second)));
    return least_s;
}

BaseStations::Base* BaseStations::choose(const GpsTime& time,
                                         const std::optional<Eigen::Vector3d>& near_ecef_m) noexcept {
    Base* nearest = nullptr;
    double least_m = std::numeric_limits<double>::infinity();
    for (Base& base : bases_) {
        if (base.heard == 0 || age_s(base, time) > settings_.max_correction_age_s) continue;
        const double distance_m = near_ecef_m ? (vector(base.antenna_ecef_m) - *near_ecef_m).norm() : 0;
        if (nearest != nullptr && distance_m >= least_m) continue;
        nearest = &base;
        least_m = distance_m;
    }
    return nearest;
}

void BaseStations::prepare(const GpsTime& time, const std::optional<Eigen::Vector3d>& near_ecef_m,
                           const EphemerisBook& ephemerides) noexcept {
    if (heard_ == 0) return;
    corrections_.fill(std::nullopt);
    Base* base = choose(time, near_ecef_m);
    if (base == nullptr) return;
    base->outcome = correct(*base, time, ephemerides);
    base->asked_s = *std::ranges::max_element(base->newest_s);
}

Exclusion BaseStations::correct(const Base& base, const GpsTime& time, const EphemerisBook& ephemerides) noexcept {
    sight(base, time, ephemerides);
    if (sights_.empty()) return Exclusion::no_ephemeris;
    if (!solve_clocks(base)) return Exclusion::inconsistent;
    put(base, time);
    return Exclusion::none;
}

/// Of each clock only what was measured together: between two epochs the base's clock may have been set.
void BaseStations::sight(const Base& base, const GpsTime& time, const EphemerisBook& ephemerides) noexcept {
    sights_.clear();
    places_.clear();
    for (std::size_t place = 0; place < base.ranges.size(); ++place) {
        const GnssBaseRange& range = base.ranges[place];
        const double age = since_s(range.time_s_in_gps_week, time.second);
        if (!is_heard(range) || range.time_s_in_gps_week != base.newest_s[base_clock(range.constellation)] ||
            std::abs(age) > settings_.max_correction_age_s)
            continue;
        const auto* ephemeris = ephemerides.find(range.constellation, range.satellite, time).ephemeris;
        const auto seen = ephemeris == nullptr ? std::nullopt : sight_of(raw_of(range, time + -age), *ephemeris);
        if (!seen) continue;
        sights_.push_back({*seen});
        places_.push_back(place);
    }
    observer_.observe(sights_, {time, ephemerides.ionosphere()}, vector(base.antenna_ecef_m));
}

/// False: the pseudoranges contradict each other at this place, and which of them is wrong does not show; or most are.
bool BaseStations::solve_clocks(const Base& base) noexcept {
    const Eigen::Vector3d antenna_ecef_m = vector(base.antenna_ecef_m);
    const auto heard = std::ranges::count(sights_, Exclusion::none, &SightFrom::reason);
    for (std::ptrdiff_t left_out = 0; 2 * left_out <= heard; ++left_out) {
        ClockEquations equations;
        clock_rows_.fill(0);
        for (const SightFrom& s : sights_) {
            if (s.reason != Exclusion::none) continue;
            equations.add(clock_row(s), beyond_model_m(s, antenna_ecef_m), s.variance_m2);
            ++clock_rows_[base_clock(s)];
        }
        for (std::size_t i = 0; i < clock_rows_.size(); ++i)
            if (clock_rows_[i] == 0) equations.hold(static_cast<int>(i));
        if (!equations.solve()) return false;
        for (std::size_t i = 0; i < clocks_m_.size(); ++i) clocks_m_[i] = equations.step()[static_cast<int>(i)];
        if (agree(equations, normal_quantile_)) return true;
        if (!tells_which(equations)) return false;
        std::ranges::max_element(sights_, {}, [&](const SightFrom& s) {
            if (s.reason != Exclusion::none) return -1.0;
            return equations.outlying(clock_row(s), beyond_model_m(s, antenna_ecef_m), s.variance_m2);
        })->reason = Exclusion::inconsistent;
    }
    return false;
}

/// A satellite that is alone in its constellation says nothing but the clock.
void BaseStations::put(const Base& base, const GpsTime& time) noexcept {
    const Eigen::Vector3d antenna_ecef_m = vector(base.antenna_ecef_m);
    const double height_m = geodetic(antenna_ecef_m).height_ellipsoid_m;
    for (std::size_t i = 0; i < sights_.size(); ++i) {
        const SightFrom& s = sights_[i];
        const std::size_t clock = base_clock(s);
        if (s.reason != Exclusion::none || clock_rows_[clock] < 2) continue;
        Reception of = s.sight.reception;
        of.elevation_rad = s.elevation_rad;
        const double age = since_s(base.newest_s[clock], time.second);
        corrections_[places_[i]] = {beyond_model_m(s, antenna_ecef_m) - clocks_m_[clock],
                                    reception_variance_m2(settings_, of) + ageing_variance_m2(age), antenna_ecef_m,
                                    height_m};
    }
}

} // namespace locus::gnss
