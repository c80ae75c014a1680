#include "fusion/gnss/glonass_strings.h"

#include "fusion/gnss/message_fields.h"

#include <bit>

namespace locus::gnss {
namespace {

constexpr std::size_t string_bits = 85;
constexpr std::size_t check_bits = 8;
constexpr double day_s = 86400, quarter_hour_s = 900;
constexpr double moscow_minus_utc_s = 3 * 3600;
constexpr double metres = 1e3; // lengths are told in kilometres

/// Bit `number` of the ICD, which counts from 85 down to 1.
unsigned bit(const MessageBits& string, std::size_t number) { return string.get(string_bits - number, 1); }

/// The sums C1 to C7 of the ICD are those of a Hamming code: bits 9 to 85 stand at the places 3, 5, 6, 7, 9 ... that
/// are no power of two, the check bits 1 to 7 at the powers, and the places of all ones add to 0. Bit 8 makes the
/// number of ones even. Single errors could be mended; they are refused.
std::uint32_t check_of(const MessageBits& string) {
    std::size_t place = 2, sum = 0;
    int ones = 0;
    for (std::size_t number = check_bits + 1; number <= string_bits; ++number) {
        while (std::has_single_bit(++place)) {
        }
        if (bit(string, number)) sum ^= place, ++ones;
    }
    const bool odd = (ones + std::popcount(sum)) % 2 != 0;
    return static_cast<std::uint32_t>(odd ? sum | 1u << (check_bits - 1) : sum);
}

constexpr std::size_t check_begin = string_bits - check_bits;

/// One axis stands in the same place in strings 1, 2 and 3.
template <class Walk, ConstOrNot<GlonassEphemeris> E>
void walk_strings(Walk& walk, E& e) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        walk.scaled_magnitude(e.velocity_mps[axis], {{axis, 21, 24}}, -20, metres);
        walk.scaled_magnitude(e.acceleration_mps2[axis], {{axis, 45, 5}}, -30, metres);
        walk.scaled_magnitude(e.position_m[axis], {{axis, 50, 27}}, -11, metres);
    }
    walk.number(e.health, {{1, 5, 1}}); // of Bn users look at the highest bit only (4.4)
    walk.scaled_magnitude(e.clock_drift, {{2, 6, 11}}, -40);
    walk.scaled_magnitude(e.clock_s, {{3, 5, 22}}, -30, -1);
    walk.number(e.age_days, {{3, 32, 5}});
    walk.number(e.satellite, {{3, 70, 5}});
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
    if (check_of(string) != string.get(check_begin, check_bits)) return std::nullopt;
    return string;
}

unsigned glonass_string_number(const MessageBits& string) noexcept { return string.get(1, 4); }

std::optional<GlonassEphemeris> glonass_ephemeris(std::span<const MessageBits, 4> strings, const GpsTime& near,
                                                  int leap_s) noexcept {
    GlonassEphemeris e;
    const FieldReader reader{strings};
    walk_strings(reader, e);
    e.frame_s_in_day = strings[0].get(9, 5) * 3600.0 + strings[0].get(14, 6) * 60.0 + strings[0].get(20, 1) * 30.0;
    const double reference_s = strings[1].get(9, 7) * quarter_hour_s;
    e.reference = in_gps_time(reference_s, near, leap_s);
    if (e.satellite == 0 || reference_s >= day_s) return std::nullopt;
    return e;
}

std::array<std::uint32_t, 4> glonass_words(MessageBits string, std::uint32_t frame) noexcept {
    string.set(check_begin, check_bits, check_of(string));
    return {string.get(0, 32), string.get(32, 32), string.get(64, 21) << 11, frame << 16};
}

std::optional<std::array<MessageBits, 4>> encode_glonass(const GlonassEphemeris& e, int leap_s) noexcept {
    std::array<MessageBits, 4> strings;
    for (std::uint32_t i = 0; i < strings.size(); ++i) strings[i] = MessageBits{string_bits}.set(1, 4, i + 1);
    FieldWriter writer{strings};
    walk_strings(writer, e);
    const double moscow_s = std::fmod((e.reference + (moscow_minus_utc_s - leap_s)).second, day_s);
    writer.scaled(moscow_s, {{1, 9, 7}}, 0, quarter_hour_s);
    const double half_minutes = e.frame_s_in_day / 30;
    writer.number(std::floor(half_minutes / 120), {{0, 9, 5}});
    writer.number(std::fmod(std::floor(half_minutes), 120), {{0, 14, 7}});
    if (!writer.fits() || e.satellite == 0) return std::nullopt;
    return strings;
}

} // namespace locus::gnss
