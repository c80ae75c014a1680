#include "fusion/gnss/galileo_inav.h"

#include "fusion/gnss/interface_pi.h"
#include "fusion/gnss/message_fields.h"

namespace locus::gnss {
namespace {

constexpr std::size_t words_per_part = 4;
constexpr int inav_week_modulus = 4096;

std::uint32_t crc24q(const MessageBits& bits) {
    constexpr std::uint32_t polynomial = 0x1864CFB;
    std::uint32_t crc = 0;
    for (std::size_t i = 0; i < bits.size(); ++i) {
        crc ^= bits.get(i, 1) << 23;
        crc = crc & 0x800000 ? crc << 1 ^ polynomial : crc << 1;
    }
    return crc & 0xFFFFFF;
}

MessageBits part_of(std::span<const std::uint32_t> words) {
    MessageBits part;
    for (const std::uint32_t word : words) part.append(word, 32);
    return part;
}

void copy(const MessageBits& from, std::size_t begin, std::size_t length, MessageBits& to) {
    for (std::size_t i = 0; i < length; ++i) to.append(from.get(begin + i, 1), 1);
}

template <class Walk, ConstOrNot<KeplerEphemeris> E>
void walk_inav_orbit(Walk& walk, E& e) {
    walk.scaled(e.toe_s, {{0, 16, 14}}, 0, 60);
    walk.scaled_signed(e.mean_anomaly, {{0, 30, 32}}, -31, interface_pi);
    walk.scaled(e.eccentricity, {{0, 62, 32}}, -33);
    walk.scaled(e.root_a, {{0, 94, 32}}, -19);
    walk.scaled_signed(e.node, {{1, 16, 32}}, -31, interface_pi);
    walk.scaled_signed(e.inclination, {{1, 48, 32}}, -31, interface_pi);
    walk.scaled_signed(e.perigee, {{1, 80, 32}}, -31, interface_pi);
    walk.scaled_signed(e.inclination_rate, {{1, 112, 14}}, -43, interface_pi);
    walk.scaled_signed(e.node_rate, {{2, 16, 24}}, -43, interface_pi);
    walk.scaled_signed(e.mean_motion_difference, {{2, 40, 16}}, -43, interface_pi);
    walk.scaled_signed(e.cuc, {{2, 56, 16}}, -29);
    walk.scaled_signed(e.cus, {{2, 72, 16}}, -29);
    walk.scaled_signed(e.crc_m, {{2, 88, 16}}, -5);
    walk.scaled_signed(e.crs_m, {{2, 104, 16}}, -5);
    walk.number(e.accuracy, {{2, 120, 8}});
    walk.scaled_signed(e.cic, {{3, 22, 16}}, -29);
    walk.scaled_signed(e.cis, {{3, 38, 16}}, -29);
}

template <class Walk, ConstOrNot<KeplerEphemeris> E>
void walk_inav_clock(Walk& walk, E& e) {
    walk.number(e.satellite, {{3, 16, 6}});
    walk.scaled(e.toc_s, {{3, 54, 14}}, 0, 60);
    walk.scaled_signed(e.clock_s, {{3, 68, 31}}, -34);
    walk.scaled_signed(e.clock_drift, {{3, 99, 21}}, -46);
    walk.scaled_signed(e.clock_drift_rate_per_s, {{3, 120, 6}}, -59);
    walk.scaled_signed(e.group_delay_s[0], {{4, 47, 10}}, -32);
    walk.scaled_signed(e.group_delay_s[1], {{4, 57, 10}}, -32);
    walk.number(e.health, {{4, 67, 6}});
}

} // namespace

std::optional<MessageBits> inav_word(std::span<const std::uint32_t> words) noexcept {
    if (words.size() < 2 * words_per_part) return std::nullopt;
    const MessageBits even = part_of(words.first(words_per_part));
    const MessageBits odd = part_of(words.subspan(words_per_part, words_per_part));
    const bool nominal_pair = even.get(0, 2) == 0b00 && odd.get(0, 2) == 0b10; // even/odd, page type
    MessageBits checked, word;
    copy(even, 0, 114, checked);
    copy(odd, 0, 82, checked);
    if (!nominal_pair || crc24q(checked) != odd.get(82, 24)) return std::nullopt;
    copy(even, 2, 112, word);
    copy(odd, 2, 16, word);
    return word;
}

unsigned inav_word_type(const MessageBits& word) noexcept { return word.get(0, 6); }

std::optional<KeplerEphemeris> inav_ephemeris(std::span<const MessageBits, 5> words, int near_gps_week) noexcept {
    KeplerEphemeris e;
    e.constellation = constellation::galileo;
    e.issue = e.issue_clock = static_cast<std::uint16_t>(words[0].get(6, 10));
    for (const MessageBits& word : words.first<4>())
        if (word.get(6, 10) != e.issue) return std::nullopt;
    const FieldReader reader{words};
    walk_inav_orbit(reader, e);
    walk_inav_clock(reader, e);
    const int told = static_cast<int>(words[4].get(73, 12));
    const int week = nearest_week(told, inav_week_modulus, near_gps_week - galileo_week_ahead);
    e.week = week_of(e.toe_s, {week, static_cast<double>(words[4].get(85, 20))});
    return e;
}

std::array<std::uint32_t, 8> inav_words(const MessageBits& word) noexcept {
    MessageBits even, odd, checked;
    even.append(0b00, 2);
    copy(word, 0, 112, even);
    odd.append(0b10, 2);
    copy(word, 112, 16, odd);
    odd.append(0, 32), odd.append(0, 32); // reserved, search and rescue, spare
    copy(even, 0, 114, checked);
    copy(odd, 0, 82, checked);
    odd.append(crc24q(checked), 24);
    std::array<std::uint32_t, 2 * words_per_part> words{};
    for (std::size_t i = 0; i < words_per_part; ++i) {
        words[i] = even.get(32 * i, 32);
        words[words_per_part + i] = odd.get(32 * i, 32);
    }
    return words;
}

std::optional<std::array<MessageBits, 5>> encode_inav(const KeplerEphemeris& e, const GpsTime& sent) noexcept {
    std::array<MessageBits, 5> words;
    for (std::uint32_t i = 0; i < words.size(); ++i) {
        words[i] = MessageBits{128}.set(0, 6, i + 1);
        if (i < 4) words[i].set(6, 10, e.issue);
    }
    FieldWriter writer{words};
    walk_inav_orbit(writer, e);
    walk_inav_clock(writer, e);
    words[4].set(73, 12, static_cast<std::uint32_t>((sent.week - galileo_week_ahead) % inav_week_modulus));
    words[4].set(85, 20, static_cast<std::uint32_t>(sent.second));
    if (!writer.fits() || e.issue > 1023) return std::nullopt;
    return words;
}

} // namespace locus::gnss
