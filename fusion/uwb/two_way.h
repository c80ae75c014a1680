// Two-way time of flight from raw stamps, a of the one who asks, b of the one who answers:
//
//     a   poll ----------- answer ---------------- final
//           \             /      \                /         Ra = answer - poll at a     Db = answer - poll at b
//     b      poll -- answer       ... answer -- final       Da = final - answer at a    Rb = final - answer at b
//
// Each stamp is in the clock of the device that took it. Differences of stamps, their products and their sums are
// exact.
#pragma once

#include "fusion/uwb/ticks.h"

#include <cstdint>
#include <optional>

namespace locus::uwb {

/// One question and its answer.
struct SingleSided {
    std::uint64_t poll_tx_ticks_in_a = 0;
    std::uint64_t poll_rx_ticks_in_b = 0;
    std::uint64_t answer_tx_ticks_in_b = 0;
    std::uint64_t answer_rx_ticks_in_a = 0;
};

/// And a third packet from a. It may be the next question.
struct DoubleSided {
    SingleSided first;
    std::uint64_t final_tx_ticks_in_a = 0;
    std::uint64_t final_rx_ticks_in_b = 0;
};

struct TwoWaySettings {
    WrappingClock clock{};
    double antenna_delay_ticks = 0; ///< half of what both devices add to send and receive, beyond what is programmed
    double stamp_sigma_ticks = 10;  ///< of a time of arrival; when a packet leaves is known exactly
    double rate_sigma = 1e-8;       ///< of the rate that single_sided() is given
};

struct TimeOfFlight {
    double ticks = 0;
    double sigma_ticks = 0;

    double range_m() const { return ticks * tick_m; }
    double sigma_m() const { return sigma_ticks * tick_m; }
};

/// (Ra - Db / (1 + rate)) / 2. `b_rate_less_a` is how much faster b's clock runs, as a ratio: from the radio's carrier
/// integrator, or from the intervals between polls in both clocks; 1 ppm too much costs 15 cm for each ms of Db.
/// Empty when the rate is no crystal's (beyond 1e-3) or an interval is negative, that is, longer than half the period.
/// Source: IEEE 802.15.4z-2020, 6.9.1.2.2 (single-sided ranging with clock-offset correction).
std::optional<TimeOfFlight> single_sided(const SingleSided& exchange, double b_rate_less_a,
                                         const TwoWaySettings& settings = {});

/// (Ra Rb - Da Db) / (Ra + Rb + Da + Db): the delays need not be alike and no rate is needed. Empty when an interval is
/// negative or all are zero. The flight is taken as equally long all three times.
/// Source: Neirynck, Luk, McLaughlin, An alternative double-sided two-way ranging method, WPNC 2016.
std::optional<TimeOfFlight> double_sided(const DoubleSided& exchange, const TwoWaySettings& settings = {});

} // namespace locus::uwb
