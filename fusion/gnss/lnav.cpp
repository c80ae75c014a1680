#include "fusion/gnss/lnav.h"

#include "fusion/gnss/interface_pi.h"
#include "fusion/gnss/message_fields.h"

#include <bit>

namespace locus::gnss {
namespace {

constexpr std::size_t words_per_subframe = 10;
constexpr std::uint32_t preamble = 0x8B;
constexpr double subframe_s = 6;
constexpr unsigned subframes_per_week = 100800;
constexpr int week_modulus = 1024;

/// IS-GPS-200 table 20-XIV: the data bits in each parity bit D25 to D30, and which parity bit of the word before.
struct ParityBit {
    std::uint32_t data;
    unsigned before; ///< 1: D29*, 0: D30*
};
constexpr std::array<ParityBit, 6> parity_bits{
    {{0xEC7CD2, 1}, {0x763E69, 0}, {0xBB1F34, 1}, {0x5D8F9A, 0}, {0xAEC7CD, 0}, {0x2DEA27, 1}}};

std::uint32_t parity_of(std::uint32_t data, std::uint32_t before) {
    std::uint32_t parity = 0;
    for (const ParityBit& bit : parity_bits)
        parity = parity << 1 | ((static_cast<unsigned>(std::popcount(data & bit.data)) ^ before >> bit.before) & 1);
    return parity;
}

/// Words 2 and 10: their last two data bits are those with which the parity ends with 00.
std::uint32_t with_tail(std::uint32_t data, std::uint32_t before) {
    data &= ~3u;
    while (parity_of(data, before) & 3) ++data;
    return data;
}

template <class Walk, ConstOrNot<KeplerEphemeris> E>
void walk_clock(Walk& walk, E& e) {
    walk.number(e.accuracy, {{0, 60, 4}});
    walk.number(e.health, {{0, 64, 6}});
    walk.number(e.issue_clock, {{0, 70, 2}, {0, 168, 8}});
    walk.scaled_signed(e.group_delay_s[0], {{0, 160, 8}}, -31);
    walk.scaled(e.toc_s, {{0, 176, 16}}, 4);
    walk.scaled_signed(e.clock_drift_rate_per_s, {{0, 192, 8}}, -55);
    walk.scaled_signed(e.clock_drift, {{0, 200, 16}}, -43);
    walk.scaled_signed(e.clock_s, {{0, 216, 22}}, -31);
}

template <class Walk, ConstOrNot<KeplerEphemeris> E>
void walk_orbit(Walk& walk, E& e) {
    walk.number(e.issue, {{1, 48, 8}});
    walk.scaled_signed(e.crs_m, {{1, 56, 16}}, -5);
    walk.scaled_signed(e.mean_motion_difference, {{1, 72, 16}}, -43, interface_pi);
    walk.scaled_signed(e.mean_anomaly, {{1, 88, 32}}, -31, interface_pi);
    walk.scaled_signed(e.cuc, {{1, 120, 16}}, -29);
    walk.scaled(e.eccentricity, {{1, 136, 32}}, -33);
    walk.scaled_signed(e.cus, {{1, 168, 16}}, -29);
    walk.scaled(e.root_a, {{1, 184, 32}}, -19);
    walk.scaled(e.toe_s, {{1, 216, 16}}, 4);
    walk.scaled_signed(e.cic, {{2, 48, 16}}, -29);
    walk.scaled_signed(e.node, {{2, 64, 32}}, -31, interface_pi);
    walk.scaled_signed(e.cis, {{2, 96, 16}}, -29);
    walk.scaled_signed(e.inclination, {{2, 112, 32}}, -31, interface_pi);
    walk.scaled_signed(e.crc_m, {{2, 144, 16}}, -5);
    walk.scaled_signed(e.perigee, {{2, 160, 32}}, -31, interface_pi);
    walk.scaled_signed(e.node_rate, {{2, 192, 24}}, -43, interface_pi);
    walk.scaled_signed(e.inclination_rate, {{2, 224, 14}}, -43, interface_pi);
}

} // namespace

std::optional<MessageBits> lnav_subframe(std::span<const std::uint32_t> words) noexcept {
    if (words.size() != words_per_subframe || (words[0] >> 22 & 0xFF) != preamble) return std::nullopt;
    MessageBits bits;
    std::uint32_t before = 0; // word 10 always ends with two zeros
    for (const std::uint32_t word : words) {
        // After a word that ended with D30 = 1 the data bits are sent inverted. u-blox turns all of the word round.
        const std::uint32_t turned = before & 1 ? word ^ 63 : word;
        if (parity_of(turned >> 6 & 0xFFFFFF, before) != (turned & 63)) return std::nullopt;
        before = turned & 3;
        bits.append(word >> 6, 24);
    }
    return bits;
}

unsigned lnav_subframe_number(const MessageBits& subframe) noexcept { return subframe.get(43, 3); }

std::optional<KeplerEphemeris> lnav_ephemeris(std::span<const MessageBits, 3> subframes, int near_week) noexcept {
    KeplerEphemeris e;
    const FieldReader reader{subframes};
    walk_clock(reader, e);
    walk_orbit(reader, e);
    const bool one_issue = e.issue == subframes[2].get(216, 8) && e.issue == (e.issue_clock & 0xFF);
    if (!one_issue) return std::nullopt;
    const double sent_s = subframes[0].get(24, 17) * subframe_s;
    const GpsTime sent{nearest_week(static_cast<int>(subframes[0].get(48, 10)), week_modulus, near_week), sent_s};
    e.week = week_of(e.toe_s, sent);
    return e;
}

std::array<std::uint32_t, 10> lnav_words(const MessageBits& subframe) noexcept {
    std::array<std::uint32_t, words_per_subframe> words{};
    std::uint32_t before = 0;
    for (std::size_t i = 0; i < words.size(); ++i) {
        std::uint32_t data = subframe.get(24 * i, 24);
        if (i == 1 || i == 9) data = with_tail(data, before);
        const std::uint32_t parity = parity_of(data, before), sent = before << 30 | data << 6 | parity;
        words[i] = before & 1 ? sent ^ 0xC000003F : sent;
        before = parity & 3;
    }
    return words;
}

void stamp_lnav(MessageBits& subframe, unsigned number, const GpsTime& sent) noexcept {
    const auto count = static_cast<std::uint32_t>(sent.second / subframe_s) % subframes_per_week;
    subframe.set(0, 8, preamble).set(24, 17, count).set(43, 3, number);
}

std::optional<std::array<MessageBits, 3>> encode_lnav(const KeplerEphemeris& e, const GpsTime& sent) noexcept {
    std::array<MessageBits, 3> subframes{MessageBits{240}, MessageBits{240}, MessageBits{240}};
    FieldWriter writer{subframes};
    walk_clock(writer, e);
    walk_orbit(writer, e);
    for (std::uint32_t i = 0; i < subframes.size(); ++i) stamp_lnav(subframes[i], i + 1, sent + i * subframe_s);
    subframes[0].set(48, 10, static_cast<std::uint32_t>(sent.week % week_modulus));
    subframes[2].set(216, 8, e.issue);
    const bool one_issue = e.issue == (e.issue_clock & 0xFF);
    if (!writer.fits() || !one_issue) return std::nullopt;
    return subframes;
}

} // namespace locus::gnss
