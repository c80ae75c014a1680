#include "drivers/gnss/rinex_satellite_line.h"

#include "drivers/gnss/rinex_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace locus::gnss::rinex {
namespace {

constexpr std::size_t first_value = 3, value_width = 16, digits_width = 14;

/// F14.3, then the indicator of a lost lock. Where the number is blank or 0 there is none.
std::optional<double> value_at(std::string_view line, std::size_t index, std::string& error) {
    const std::size_t begin = first_value + value_width * index;
    const std::string_view text = columns(line, begin, digits_width);
    if (text.empty()) return std::nullopt;
    const auto value = real(text);
    if (!value || line.size() < begin + digits_width) {
        error = fmt::format("'{}' in column {} is no whole number with its decimals", text, begin + 1);
        return std::nullopt;
    }
    return *value == 0 ? std::nullopt : value;
}

/// Bits: lock lost since the epoch before, half a cycle in doubt.
int loss_of_lock_at(std::string_view line, std::size_t index) {
    return whole(columns(line, first_value + value_width * index + digits_width, 1)).value_or(0);
}

void put(Signal& signal, char kind, double value, int loss_of_lock) {
    switch (kind) {
    case 'C':
        signal.range_m = value;
        break;
    case 'L':
        signal.carrier_cycles = value;
        signal.slipped = loss_of_lock & 1;
        signal.half_cycle = loss_of_lock & 2;
        break;
    case 'D':
        signal.doppler_hz = value;
        break;
    case 'S':
        signal.strength_dbhz = value;
        break;
    default:
        break;
    }
}

} // namespace

std::vector<Signal> signals_of(std::string_view line, const std::vector<std::string>& types, std::string& error) {
    std::vector<Signal> signals;
    for (std::size_t i = 0; i < types.size(); ++i) {
        const auto value = value_at(line, i, error);
        if (!value) continue;
        const std::string_view code = std::string_view(types[i]).substr(1);
        auto signal = std::find_if(signals.begin(), signals.end(), [&](const Signal& s) { return s.code == code; });
        if (signal == signals.end()) signal = signals.insert(signals.end(), Signal{.code = code});
        put(*signal, types[i][0], *value, loss_of_lock_at(line, i));
    }
    return signals;
}

} // namespace locus::gnss::rinex
