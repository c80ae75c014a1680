#include "fusion/gnss/glonass_strings.h"

#include <bit>

namespace locus::gnss {
namespace {

constexpr std::size_t string_bits = 85;
constexpr std::size_t check_bits = 8;
constexpr double day_s = 86400;
constexpr double moscow_minus_utc_s = 3 * 3600;
constexpr double metres = 1e3; // lengths are told in kilometres

/// Bit `number` of the ICD, which counts from 85 down to 1.
unsigned bit(const MessageBits& string, std::size_t number) { return string.get(string_bits - number, 1); }

/// The sums C1 to C7 of the ICD are those of a Hamming code: bits 9 to 85 stand at the places 3, 5, 6, 7, 9 ... that
/// are no power of two, the check bits 1 to 7 at the powers, and the places of all ones add to 0. Bit 8 makes the
/// number of ones even. Single errors could be mended; they are refused.
bool checks_good(const MessageBits& string) {
    std::size_t place = 2;
    std::size_t sum = 0;
    unsigned ones = 0;
    for (std::size_t number = check_bits + 1; number <= string_bits; ++number) {
        while (std::has_single_bit(++place)) {
        }
        if (bit(string, number)) sum ^= place, ++ones;
    }
    for (std::size_t i = 0; i < check_bits; ++i) {
        if (!bit(string, i + 1)) continue;
        ++ones;
        if (i + 1 < check_bits) sum ^= std::size_t{1} << i;
    }
    return sum == 0 && ones % 2 == 0;
}

/// One axis stands in the same place in strings 1, 2 and 3.
void read_axis(const MessageBits& string, std::size_t axis, GlonassEphemeris& e) {
    e.velocity_mps[axis] = string.scaled_magnitude(21, 24, -20) * metres;
    e.acceleration_mps2[axis] = string.scaled_magnitude(45, 5, -30) * metres;
    e.position_m[axis] = string.scaled_magnitude(50, 27, -11) * metres;
}

/// GPS time of a time of day in Moscow, on the day that brings it closest to `near`.
GpsTime in_gps_time(double moscow_s_in_day, const GpsTime& near, int leap_s) {
    const double second_in_day = moscow_s_in_day - moscow_minus_utc_s + leap_s;
    const GpsTime begin_of_day{near.week, std::floor(near.second / day_s) * day_s};
    const GpsTime today = begin_of_day + second_in_day;
    const double ahead_s = today - near;
    return today + (ahead_s > day_s / 2 ? -day_s : ahead_s < -day_s / 2 ? day_s : 0);
}

} // namespace

std::optional<MessageBits> glonass_string(std::span<const std::uint32_t> words) noexcept {
    if (words.size() < 3) return std::nullopt;
    MessageBits string;
    string.append(words[0], 32);
    string.append(words[1], 32);
    string.append(words[2] >> 11, 21);
    if (!checks_good(string)) return std::nullopt;
    return string;
}

unsigned glonass_string_number(const MessageBits& string) noexcept { return string.get(1, 4); }

std::optional<GlonassEphemeris> glonass_ephemeris(std::span<const MessageBits, 4> strings, const GpsTime& near,
                                                  int leap_s) noexcept {
    GlonassEphemeris e;
    for (std::size_t axis = 0; axis < 3; ++axis) read_axis(strings[axis], axis, e);
    e.frame_s_in_day = strings[0].get(9, 5) * 3600.0 + strings[0].get(14, 6) * 60.0 + strings[0].get(20, 1) * 30.0;
    e.health = static_cast<std::uint8_t>(strings[1].get(5, 1)); // of Bn users look at the highest bit only (4.4)
    const double reference_s = strings[1].get(9, 7) * 900.0;    // quarters of an hour
    e.clock_drift = strings[2].scaled_magnitude(6, 11, -40);
    e.clock_s = -strings[3].scaled_magnitude(5, 22, -30);
    e.age_days = static_cast<std::uint8_t>(strings[3].get(32, 5));
    e.satellite = static_cast<std::uint8_t>(strings[3].get(70, 5));
    e.reference = in_gps_time(reference_s, near, leap_s);
    if (e.satellite == 0 || reference_s >= day_s) return std::nullopt;
    return e;
}

} // namespace locus::gnss
