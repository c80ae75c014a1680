#include "fusion/gnss/galileo_inav.h"

#include "fusion/gnss/interface_pi.h"

namespace locus::gnss {
namespace {

constexpr std::size_t words_per_part = 4;

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

void read_orbit(std::span<const MessageBits, 5> words, KeplerEphemeris& e) {
    e.toe_s = words[0].get(16, 14) * 60.0;
    e.mean_anomaly = words[0].scaled_signed(30, 32, -31) * interface_pi;
    e.eccentricity = words[0].scaled(62, 32, -33);
    e.root_a = words[0].scaled(94, 32, -19);
    e.node = words[1].scaled_signed(16, 32, -31) * interface_pi;
    e.inclination = words[1].scaled_signed(48, 32, -31) * interface_pi;
    e.perigee = words[1].scaled_signed(80, 32, -31) * interface_pi;
    e.inclination_rate = words[1].scaled_signed(112, 14, -43) * interface_pi;
    e.node_rate = words[2].scaled_signed(16, 24, -43) * interface_pi;
    e.mean_motion_difference = words[2].scaled_signed(40, 16, -43) * interface_pi;
    e.cuc = words[2].scaled_signed(56, 16, -29);
    e.cus = words[2].scaled_signed(72, 16, -29);
    e.crc_m = words[2].scaled_signed(88, 16, -5);
    e.crs_m = words[2].scaled_signed(104, 16, -5);
    e.accuracy = static_cast<std::uint8_t>(words[2].get(120, 8));
    e.cic = words[3].scaled_signed(22, 16, -29);
    e.cis = words[3].scaled_signed(38, 16, -29);
}

void read_clock(const MessageBits& fourth, const MessageBits& fifth, KeplerEphemeris& e) {
    e.satellite = static_cast<std::uint8_t>(fourth.get(16, 6));
    e.toc_s = fourth.get(54, 14) * 60.0;
    e.clock_s = fourth.scaled_signed(68, 31, -34);
    e.clock_drift = fourth.scaled_signed(99, 21, -46);
    e.clock_drift_rate_per_s = fourth.scaled_signed(120, 6, -59);
    e.group_delay_s = {fifth.scaled_signed(47, 10, -32), fifth.scaled_signed(57, 10, -32)};
    e.health = static_cast<std::uint8_t>(fifth.get(67, 6));
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
    read_orbit(words, e);
    read_clock(words[3], words[4], e);
    const int told = static_cast<int>(words[4].get(73, 12));
    const int week = nearest_week(told, 4096, near_gps_week - galileo_week_ahead);
    e.week = week_of(e.toe_s, {week, static_cast<double>(words[4].get(85, 20))});
    return e;
}

} // namespace locus::gnss
