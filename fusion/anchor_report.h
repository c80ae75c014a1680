// What is known of an anchor's health, beside what became of its last measurement (aid_status.h): a state that outlives
// single measurements, and for one that was moved where it seems to stand.
#pragma once

#include "fusion/measurement.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace locus {

enum class AnchorState : std::uint8_t { not_heard, joined, good, blocked, moved, doubtful, silent, count_ };

struct AnchorStateText {
    std::string_view name;
    std::string_view sentence;
};

inline constexpr std::array<AnchorStateText, static_cast<std::size_t>(AnchorState::count_)> anchor_state_texts{{
    {"not_heard", "never heard: is it powered, and is its address right?"},
    {"new", "heard, but not yet long enough together with four others to be judged"},
    {"good", "agrees with the others"},
    {"blocked", "its ranges are too long most of the time: something stands in the way, or its antenna delay is wrong"},
    {"moved", "it does not stand where the settings say: survey it again"},
    {"doubtful", "disagrees with the others; why cannot be told yet"},
    {"silent", "was heard and is no more: power, cable or radio"},
}};

constexpr std::string_view anchor_state_name(AnchorState state) {
    return anchor_state_texts[static_cast<std::size_t>(state)].name;
}
constexpr std::string_view anchor_state_sentence(AnchorState state) {
    return anchor_state_texts[static_cast<std::size_t>(state)].sentence;
}

struct AnchorReport {
    AnchorState state = AnchorState::not_heard;
    Timestamp since{};            ///< of the state
    float residual_m = unknown_f; ///< by which its ranges are longer than the other anchors let expect, lately
    float residual_sigma_m = unknown_f;
    float blocked_share = 0;   ///< 0..1 of the last ten seconds or so in which its ranges were too long
    float moved_m = unknown_f; ///< how far it stands from where the settings say; NaN: it was not moved
    /// Where it seems to stand; a coordinate is NaN while it has not been seen from enough sides.
    Vec3f stands_site_m = unknown_vec3f;
    std::array<float, 6> stands_covariance_m2{}; ///< xx, xy, xz, yy, yz, zz
};

} // namespace locus
