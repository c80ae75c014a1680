#include "fusion/gnss/beidou_d1.h"

#include "fusion/gnss/interface_pi.h"

namespace locus::gnss {
namespace {

constexpr std::size_t d1_words_per_subframe = 10;
constexpr std::uint32_t d1_preamble = 0b11100010010;
constexpr double seconds_per_subframe = 6;

/// Remainder of 15 bits by x^4 + x + 1.
bool bch_good(std::uint32_t block) {
    for (unsigned i = 14; i >= 4; --i)
        if (block >> i & 1) block ^= 0b10011u << (i - 4);
    return block == 0;
}

/// The two blocks of a word, which u-blox hands over one after the other and not bit by bit in turn as they were sent:
/// 11 bits and 11 bits of information, 4 and 4 of code.
bool d1_word_good(std::uint32_t word) {
    return bch_good((word >> 19 & 0x7FF) << 4 | (word >> 4 & 15)) && bch_good((word >> 8 & 0x7FF) << 4 | (word & 15));
}

void d1_read_clock(const MessageBits& bits, KeplerEphemeris& e) {
    e.health = static_cast<std::uint8_t>(bits.get(38, 1));
    e.issue_clock = static_cast<std::uint16_t>(bits.get(39, 5));
    e.accuracy = static_cast<std::uint8_t>(bits.get(44, 4));
    e.toc_s = bits.scaled(61, 17, 3);
    e.group_delay_s = {bits.get_signed(78, 10) * 1e-10, bits.get_signed(88, 10) * 1e-10};
    e.clock_drift_rate_per_s = bits.scaled_signed(162, 11, -66);
    e.clock_s = bits.scaled_signed(173, 24, -33);
    e.clock_drift = bits.scaled_signed(197, 22, -50);
    e.issue = static_cast<std::uint16_t>(bits.get(219, 5));
}

void d1_read_orbit(const MessageBits& second, const MessageBits& third, KeplerEphemeris& e) {
    e.mean_motion_difference = second.scaled_signed(38, 16, -43) * interface_pi;
    e.cuc = second.scaled_signed(54, 18, -31);
    e.mean_anomaly = second.scaled_signed(72, 32, -31) * interface_pi;
    e.eccentricity = second.scaled(104, 32, -33);
    e.cus = second.scaled_signed(136, 18, -31);
    e.crc_m = second.scaled_signed(154, 18, -6);
    e.crs_m = second.scaled_signed(172, 18, -6);
    e.root_a = second.scaled(190, 32, -19);
    e.toe_s = static_cast<double>(second.get(222, 2) << 15 | third.get(38, 15)) * 8;
    e.inclination = third.scaled_signed(53, 32, -31) * interface_pi;
    e.cic = third.scaled_signed(85, 18, -31);
    e.node_rate = third.scaled_signed(103, 24, -43) * interface_pi;
    e.cis = third.scaled_signed(127, 18, -31);
    e.inclination_rate = third.scaled_signed(145, 14, -43) * interface_pi;
    e.node = third.scaled_signed(159, 32, -31) * interface_pi;
    e.perigee = third.scaled_signed(191, 32, -31) * interface_pi;
}

double sent_s(const MessageBits& subframe) { return subframe.get(18, 20); }

} // namespace

std::optional<MessageBits> d1_subframe(std::span<const std::uint32_t> words) noexcept {
    if (words.size() != d1_words_per_subframe || (words[0] >> 19 & 0x7FF) != d1_preamble) return std::nullopt;
    MessageBits bits;
    if (!bch_good(words[0] & 0x7FFF)) return std::nullopt; // of the first word only the second half is coded
    bits.append(words[0] >> 4, 26);
    for (const std::uint32_t word : words.subspan(1)) {
        if (!d1_word_good(word)) return std::nullopt;
        bits.append(word >> 8, 22);
    }
    return bits;
}

unsigned d1_subframe_number(const MessageBits& subframe) noexcept { return subframe.get(15, 3); }

std::optional<KeplerEphemeris> d1_ephemeris(std::span<const MessageBits, 3> subframes) noexcept {
    const double first_s = sent_s(subframes[0]);
    if (sent_s(subframes[1]) != first_s + seconds_per_subframe ||
        sent_s(subframes[2]) != first_s + 2 * seconds_per_subframe)
        return std::nullopt;
    KeplerEphemeris e;
    e.constellation = constellation::beidou;
    d1_read_clock(subframes[0], e);
    d1_read_orbit(subframes[1], subframes[2], e);
    e.week = week_of(e.toe_s, {static_cast<int>(subframes[0].get(48, 13)), first_s});
    return e;
}

} // namespace locus::gnss
