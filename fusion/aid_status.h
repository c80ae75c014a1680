// One record for every source of aid, whatever its kind: an anchor, a camera, a satellite, a beacon, an IMU.
#pragma once

#include "fusion/anchor_report.h"
#include "fusion/measurement.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace locus {

/// Why an observation was used or not. Every value has one sentence in exclusion_sentence().
enum class Exclusion : std::uint8_t {
    none,
    not_seen_yet,
    unknown_source,
    unknown_target,
    unsupported_kind,
    not_finite,
    out_of_reach,
    late,
    stamp_in_future,
    duplicate,
    window_full,
    waiting_for_start,
    geometry_too_few,
    geometry_degenerate,
    geometry_mirror,
    innovation_too_large,
    clock_not_synchronised,
    clock_jumped,
    impossible_difference,
    reported_blocked,
    disabled,
    peer_without_position,
    no_news,
    no_ephemeris,
    ephemeris_too_old,
    unhealthy,
    impossible_orbit,
    impossible_range,
    impossible_time,
    other_signal,
    too_weak,
    too_low,
    inconsistent,
    no_position_yet,
    not_given_out,
    site_without_origin,
    unknown_camera,
    nobody_known,
    unknown_beacon,
    base_without_place,
    nothing_to_correct,
    no_attitude,
    wrong_baseline,
    count_
};

inline constexpr std::size_t exclusion_count = static_cast<std::size_t>(Exclusion::count_);

struct ExclusionText {
    std::string_view name;
    std::string_view sentence;
};

inline constexpr std::array<ExclusionText, exclusion_count> exclusion_texts{{
    {"used", "used"},
    {"not_seen_yet", "nothing heard from it yet"},
    {"unknown_source", "its address is not among the anchors of the site"},
    {"unknown_target", "its tag is not configured and there is no room for another"},
    {"unsupported_kind", "this estimator has no use for this kind of measurement"},
    {"not_finite", "the value is not a finite number"},
    {"out_of_reach", "range longer than the anchor can see"},
    {"late", "arrived after its time had left the window (fusion.window_s)"},
    {"stamp_in_future", "stamped later than the present"},
    {"duplicate", "the same sample came twice"},
    {"window_full", "more measurements in the window than it has room for"},
    {"waiting_for_start", "kept until there is enough for a first position"},
    {"geometry_too_few", "too few anchors heard for a position"},
    {"geometry_degenerate", "anchors stand so that no position follows from them"},
    {"geometry_mirror", "geometry cannot tell left from right"},
    {"innovation_too_large", "disagrees with the other sources by more than chance allows"},
    {"clock_not_synchronised", "clock of this anchor not synchronised yet"},
    {"clock_jumped", "a clock jumped, as when an anchor is started anew; it is being learnt again"},
    {"impossible_difference", "heard earlier or later than the distance between the anchors allows"},
    {"reported_blocked", "the device itself reports a blocked path"},
    {"disabled", "switched off in the settings"},
    {"peer_without_position", "the tag at the other end has no position itself"},
    {"no_news", "what the tag at the other end knows would not make this one surer"},
    {"no_ephemeris", "what the satellite says of its orbit has not been heard in full yet"},
    {"ephemeris_too_old", "what the satellite last said of its orbit is too old"},
    {"unhealthy", "the satellite says itself that it is not to be used"},
    {"impossible_orbit", "what the satellite says of its orbit or clock cannot be"},
    {"impossible_range", "no satellite can be as near or as far as this pseudorange says"},
    {"impossible_time", "the receiver's time lies in no week of GPS"},
    {"other_signal", "of each satellite only the signal at L1 (E1, B1I) is used"},
    {"too_weak", "the signal is weaker than the settings allow"},
    {"too_low", "the satellite stands too low in the sky"},
    {"inconsistent", "the pseudorange does not agree with those of the other satellites"},
    {"no_position_yet", "too few satellites for a first position, which the corrections for the air need"},
    {"not_given_out", "gnss.satellite_ranges is switched off and no fix could be made of it"},
    {"site_without_origin", "the site does not say where on the Earth it lies: set site.origin"},
    {"unknown_camera", "it is none of the cameras in the settings"},
    {"nobody_known", "nobody's tag is where these feet are, or it is not sure yet whose"},
    {"unknown_beacon", "it is neither in the radio map nor, where there is none, among the anchors of the site"},
    {"base_without_place", "the base station has not told yet where it stands (RTCM 1005 or 1006)"},
    {"nothing_to_correct", "no receiver's raw observations have come since that it could correct"},
    {"no_attitude", "no inertial sensor has shown for a second which way is down, which a heading needs"},
    {"wrong_baseline", "its two antennas are not as far apart as the settings say: its carrier cycles are miscounted"},
}};

constexpr std::string_view exclusion_name(Exclusion reason) {
    return exclusion_texts[static_cast<std::size_t>(reason)].name;
}
constexpr std::string_view exclusion_sentence(Exclusion reason) {
    return exclusion_texts[static_cast<std::size_t>(reason)].sentence;
}

/// What became of the change of a satellite's carrier that ended with its epoch before the last observation.
enum class CarrierUse : std::uint8_t { none, used, new_lock, slipped, count_ };

inline constexpr std::array<ExclusionText, static_cast<std::size_t>(CarrierUse::count_)> carrier_texts{{
    {"none", "no carrier, or not used"},
    {"used", "used with its carrier"},
    {"new_lock", "used; its carrier was locked anew"},
    {"slipped", "used; its carrier disagrees with its Doppler or the other sources"},
}};

/// What an estimator answers to one observation.
struct Verdict {
    Exclusion reason = Exclusion::none;
    float innovation = unknown_f;       ///< unit of the observation
    float innovation_sigma = unknown_f; ///< predicted standard deviation of the innovation
    float test_ratio = unknown_f;       ///< |innovation| over the gate; above 1 would be excluded
    float weight = 1;                   ///< robust weight, 0..1
    CarrierUse carrier = CarrierUse::none;
};

/// Of an innovation and its predicted standard deviation, before a gate at `limit_in_sigma` decides.
inline Verdict verdict_of(double innovation, double innovation_sigma, double limit_in_sigma) noexcept {
    return {Exclusion::none,
            static_cast<float>(innovation),
            static_cast<float>(innovation_sigma),
            static_cast<float>(std::abs(innovation) / (innovation_sigma * limit_in_sigma)),
            1,
            CarrierUse::none};
}

/// The same measurement kept out, so that nothing of it counts.
inline Verdict kept_out(Verdict verdict, Exclusion reason = Exclusion::innovation_too_large) noexcept {
    verdict.reason = reason;
    verdict.weight = 0;
    return verdict;
}

enum class SourceKind : std::uint8_t { anchor, camera, satellite, beacon, imu, vehicle, input, tag, base, heading };

/// received = used + refused + late + those still waiting for their tick.
struct AidCounters {
    std::uint64_t received = 0;
    std::uint64_t used = 0;
    std::uint64_t refused = 0; ///< for whatever reason but `late`
    std::uint64_t late = 0;
};

/// received = used + late + refused + those still waiting for their tick. A measurement between two tags, or a
/// sync packet between two anchors, counts once for each. Exact also when a roll-back changes a verdict: the new one
/// replaces the old.
struct EngineCounters {
    std::uint64_t received = 0;
    std::uint64_t used = 0;
    std::uint64_t late = 0;
    std::uint64_t refused = 0;                              ///< for whatever reason but `late`
    std::uint64_t rolled_back = 0;                          ///< times that a target went back to a snapshot
    std::array<std::uint64_t, exclusion_count> by_reason{}; ///< index: Exclusion; by_reason[none] == used
};

struct AidStatus {
    SourceKind kind = SourceKind::anchor;
    Address source = no_address;
    std::uint16_t input = 0; ///< input that last brought it
    Address last_target = no_address;
    Timestamp last_time{};      ///< stamp of the last observation
    Timestamp last_used_time{}; ///< stamp of the last one used
    double last_observation = 0;
    Verdict last_verdict{Exclusion::not_seen_yet};
    AidCounters counters;
    float rate_hz = 0;   ///< of what was heard, used or not; smoothed
    float delay_s = 0;   ///< arrival less stamp, smoothed
    AnchorReport health; ///< of an anchor of the site
};

} // namespace locus
