#include "fusion/uwb/two_way.h"

#include <cmath>

namespace locus::uwb {
namespace {

/// A product of two intervals has up to 78 bits.
__extension__ using WideTicks = __int128;

constexpr double fastest_rate = 1e-3;

/// Longer than half the period is taken for a negative one: the packets are not in the order that is claimed.
bool is_forwards(std::int64_t interval_ticks, const WrappingClock& clock) {
    return interval_ticks < clock.period_ticks() / 2;
}

/// Rounded once: the whole part and the rest are each exact.
double quotient(WideTicks numerator, std::int64_t denominator) {
    const auto whole = static_cast<double>(static_cast<std::int64_t>(numerator / denominator));
    const auto rest = static_cast<double>(static_cast<std::int64_t>(numerator % denominator));
    return whole + rest / static_cast<double>(denominator);
}

} // namespace

std::optional<TimeOfFlight> single_sided(const SingleSided& exchange, double b_rate_less_a,
                                         const TwoWaySettings& settings) {
    const WrappingClock& clock = settings.clock;
    const std::int64_t round_a = clock.since(exchange.answer_rx_ticks_in_a, exchange.poll_tx_ticks_in_a);
    const std::int64_t reply_b = clock.since(exchange.answer_tx_ticks_in_b, exchange.poll_rx_ticks_in_b);
    if (!(std::abs(b_rate_less_a) <= fastest_rate)) return std::nullopt;
    if (!is_forwards(round_a, clock) || !is_forwards(reply_b, clock)) return std::nullopt;
    const auto reply_ticks = static_cast<double>(reply_b);
    const double longer_in_b_ticks = reply_ticks * (b_rate_less_a / (1 + b_rate_less_a));
    const double flight_ticks = (static_cast<double>(round_a - reply_b) + longer_in_b_ticks) / 2;
    const double stamps_ticks = std::sqrt(0.5) * settings.stamp_sigma_ticks; // two arrivals, halved
    return TimeOfFlight{flight_ticks - settings.antenna_delay_ticks,
                        std::hypot(stamps_ticks, reply_ticks * settings.rate_sigma / 2)};
}

std::optional<TimeOfFlight> double_sided(const DoubleSided& exchange, const TwoWaySettings& settings) {
    const WrappingClock& clock = settings.clock;
    const SingleSided& first = exchange.first;
    const std::int64_t round_a = clock.since(first.answer_rx_ticks_in_a, first.poll_tx_ticks_in_a);
    const std::int64_t reply_b = clock.since(first.answer_tx_ticks_in_b, first.poll_rx_ticks_in_b);
    const std::int64_t reply_a = clock.since(exchange.final_tx_ticks_in_a, first.answer_rx_ticks_in_a);
    const std::int64_t round_b = clock.since(exchange.final_rx_ticks_in_b, first.answer_tx_ticks_in_b);
    for (const std::int64_t interval : {round_a, reply_b, reply_a, round_b})
        if (!is_forwards(interval, clock)) return std::nullopt;
    const std::int64_t sum = round_a + reply_b + reply_a + round_b;
    if (sum == 0) return std::nullopt;
    const WideTicks numerator = WideTicks{round_a} * round_b - WideTicks{reply_a} * reply_b;
    // The three arrivals' shares by the partial derivatives, with flight << replies, so that Ra ~ Db and Rb ~ Da.
    const double a_share = 2 * static_cast<double>(reply_a) / static_cast<double>(sum);
    const double b_share = 2 * static_cast<double>(reply_b) / static_cast<double>(sum);
    const double sigma_ticks = settings.stamp_sigma_ticks / 2 * std::hypot(1.0, a_share, b_share);
    return TimeOfFlight{quotient(numerator, sum) - settings.antenna_delay_ticks, sigma_ticks};
}

} // namespace locus::uwb
