#include "fusion/gnss/beidou_d1.h"

#include "fusion/gnss/interface_pi.h"
#include "fusion/gnss/message_fields.h"

namespace locus::gnss {
namespace {

constexpr std::size_t d1_words_per_subframe = 10;
constexpr double seconds_per_subframe = 6;

/// The 4 bits of code for 11 bits of information: remainder by x^4 + x + 1.
std::uint32_t bch(std::uint32_t data) {
    std::uint32_t rest = data << 4;
    for (unsigned i = 14; i >= 4; --i)
        if (rest >> i & 1) rest ^= 0b10011u << (i - 4);
    return rest;
}

/// Of 22 bits. u-blox hands the two blocks of a word over one after the other and not bit by bit in turn as they were
/// sent: 11 bits and 11 bits of information, 4 and 4 of code.
std::uint32_t d1_word(std::uint32_t data) { return data << 8 | bch(data >> 11) << 4 | bch(data & 0x7FF); }

template <class Walk, ConstOrNot<KeplerEphemeris> E>
void walk_d1_clock(Walk& walk, E& e) {
    walk.number(e.health, {{0, 38, 1}});
    walk.number(e.issue_clock, {{0, 39, 5}});
    walk.number(e.accuracy, {{0, 44, 4}});
    walk.scaled(e.toc_s, {{0, 61, 17}}, 3);
    walk.scaled_signed(e.group_delay_s[0], {{0, 78, 10}}, 0, 1e-10);
    walk.scaled_signed(e.group_delay_s[1], {{0, 88, 10}}, 0, 1e-10);
    walk.scaled_signed(e.clock_drift_rate_per_s, {{0, 162, 11}}, -66);
    walk.scaled_signed(e.clock_s, {{0, 173, 24}}, -33);
    walk.scaled_signed(e.clock_drift, {{0, 197, 22}}, -50);
    walk.number(e.issue, {{0, 219, 5}});
}

template <class Walk, ConstOrNot<KeplerEphemeris> E>
void walk_d1_orbit(Walk& walk, E& e) {
    walk.scaled_signed(e.mean_motion_difference, {{1, 38, 16}}, -43, interface_pi);
    walk.scaled_signed(e.cuc, {{1, 54, 18}}, -31);
    walk.scaled_signed(e.mean_anomaly, {{1, 72, 32}}, -31, interface_pi);
    walk.scaled(e.eccentricity, {{1, 104, 32}}, -33);
    walk.scaled_signed(e.cus, {{1, 136, 18}}, -31);
    walk.scaled_signed(e.crc_m, {{1, 154, 18}}, -6);
    walk.scaled_signed(e.crs_m, {{1, 172, 18}}, -6);
    walk.scaled(e.root_a, {{1, 190, 32}}, -19);
    walk.scaled(e.toe_s, {{1, 222, 2}, {2, 38, 15}}, 3);
    walk.scaled_signed(e.inclination, {{2, 53, 32}}, -31, interface_pi);
    walk.scaled_signed(e.cic, {{2, 85, 18}}, -31);
    walk.scaled_signed(e.node_rate, {{2, 103, 24}}, -43, interface_pi);
    walk.scaled_signed(e.cis, {{2, 127, 18}}, -31);
    walk.scaled_signed(e.inclination_rate, {{2, 145, 14}}, -43, interface_pi);
    walk.scaled_signed(e.node, {{2, 159, 32}}, -31, interface_pi);
    walk.scaled_signed(e.perigee, {{2, 191, 32}}, -31, interface_pi);
}

double sent_s(const MessageBits& subframe) { return subframe.get(18, 20); }

} // namespace

std::optional<MessageBits> d1_subframe(std::span<const std::uint32_t> words) noexcept {
    if (words.size() != d1_words_per_subframe || (words[0] >> 19 & 0x7FF) != d1_preamble) return std::nullopt;
    MessageBits bits;
    const bool coded = bch(words[0] >> 4 & 0x7FF) == (words[0] & 15); // of the first word only the second half is
    if (!coded) return std::nullopt;
    bits.append(words[0] >> 4, 26);
    for (const std::uint32_t word : words.subspan(1)) {
        if (d1_word(word >> 8 & 0x3FFFFF) != (word & 0x3FFFFFFF)) return std::nullopt;
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
    const FieldReader reader{subframes};
    walk_d1_clock(reader, e);
    walk_d1_orbit(reader, e);
    e.week = week_of(e.toe_s, {static_cast<int>(subframes[0].get(48, 13)), first_s});
    return e;
}

std::array<std::uint32_t, 10> d1_words(const MessageBits& subframe) noexcept {
    std::array<std::uint32_t, d1_words_per_subframe> words{subframe.get(0, 26) << 4 | bch(subframe.get(15, 11))};
    for (std::size_t i = 1; i < words.size(); ++i) words[i] = d1_word(subframe.get(26 + 22 * (i - 1), 22));
    return words;
}

std::optional<std::array<MessageBits, 3>> encode_d1(const KeplerEphemeris& e, const GpsTime& sent) noexcept {
    constexpr double frame_s = 30;
    const GpsTime time = sent + -gps_minus_beidou_s;
    std::array<MessageBits, 3> subframes{MessageBits{224}, MessageBits{224}, MessageBits{224}};
    FieldWriter writer{subframes};
    walk_d1_clock(writer, e);
    walk_d1_orbit(writer, e);
    const double first_s = std::floor(time.second / frame_s) * frame_s;
    for (std::uint32_t i = 0; i < subframes.size(); ++i) {
        const auto second = static_cast<std::uint32_t>(first_s + i * seconds_per_subframe);
        subframes[i].set(0, 11, d1_preamble).set(15, 3, i + 1).set(18, 20, second);
    }
    writer.number(time.week - beidou_week_ahead, {{0, 48, 13}});
    if (!writer.fits()) return std::nullopt;
    return subframes;
}

} // namespace locus::gnss
