#include "fusion/gnss/lnav.h"

#include "fusion/gnss/interface_pi.h"

#include <bit>

namespace locus::gnss {
namespace {

constexpr std::size_t words_per_subframe = 10;
constexpr std::uint32_t preamble = 0x8B;

/// IS-GPS-200 table 20-XIV: the data bits in each parity bit D25 to D30, and which parity bit of the word before.
struct ParityBit {
    std::uint32_t data;
    unsigned before; ///< 1: D29*, 0: D30*
};
constexpr std::array<ParityBit, 6> parity_bits{
    {{0xEC7CD2, 1}, {0x763E69, 0}, {0xBB1F34, 1}, {0x5D8F9A, 0}, {0xAEC7CD, 0}, {0x2DEA27, 1}}};

/// `word` as it was sent but for its data bits, which stand as they were before sending; `before`: D29* and D30*.
bool parity_good(std::uint32_t word, std::uint32_t before) {
    const std::uint32_t data = word >> 6 & 0xFFFFFF;
    std::uint32_t parity = 0;
    for (const ParityBit& bit : parity_bits)
        parity = parity << 1 | ((static_cast<unsigned>(std::popcount(data & bit.data)) ^ before >> bit.before) & 1);
    return parity == (word & 63);
}

void read_clock(const MessageBits& bits, KeplerEphemeris& e) {
    e.accuracy = static_cast<std::uint8_t>(bits.get(60, 4));
    e.health = static_cast<std::uint8_t>(bits.get(64, 6));
    e.issue_clock = static_cast<std::uint16_t>(bits.get(70, 2) << 8 | bits.get(168, 8));
    e.group_delay_s[0] = bits.scaled_signed(160, 8, -31);
    e.toc_s = bits.scaled(176, 16, 4);
    e.clock_drift_rate_per_s = bits.scaled_signed(192, 8, -55);
    e.clock_drift = bits.scaled_signed(200, 16, -43);
    e.clock_s = bits.scaled_signed(216, 22, -31);
}

void read_orbit(const MessageBits& second, const MessageBits& third, KeplerEphemeris& e) {
    e.issue = static_cast<std::uint16_t>(second.get(48, 8));
    e.crs_m = second.scaled_signed(56, 16, -5);
    e.mean_motion_difference = second.scaled_signed(72, 16, -43) * interface_pi;
    e.mean_anomaly = second.scaled_signed(88, 32, -31) * interface_pi;
    e.cuc = second.scaled_signed(120, 16, -29);
    e.eccentricity = second.scaled(136, 32, -33);
    e.cus = second.scaled_signed(168, 16, -29);
    e.root_a = second.scaled(184, 32, -19);
    e.toe_s = second.scaled(216, 16, 4);
    e.cic = third.scaled_signed(48, 16, -29);
    e.node = third.scaled_signed(64, 32, -31) * interface_pi;
    e.cis = third.scaled_signed(96, 16, -29);
    e.inclination = third.scaled_signed(112, 32, -31) * interface_pi;
    e.crc_m = third.scaled_signed(144, 16, -5);
    e.perigee = third.scaled_signed(160, 32, -31) * interface_pi;
    e.node_rate = third.scaled_signed(192, 24, -43) * interface_pi;
    e.inclination_rate = third.scaled_signed(224, 14, -43) * interface_pi;
}

} // namespace

std::optional<MessageBits> lnav_subframe(std::span<const std::uint32_t> words) noexcept {
    if (words.size() != words_per_subframe || (words[0] >> 22 & 0xFF) != preamble) return std::nullopt;
    MessageBits bits;
    std::uint32_t before = 0; // word 10 always ends with two zeros
    for (const std::uint32_t word : words) {
        // After a word that ended with D30 = 1 the data bits are sent inverted. u-blox turns all of the word round.
        const std::uint32_t turned = before & 1 ? word ^ 63 : word;
        if (!parity_good(turned, before)) return std::nullopt;
        before = turned & 3;
        bits.append(word >> 6, 24);
    }
    return bits;
}

unsigned lnav_subframe_number(const MessageBits& subframe) noexcept { return subframe.get(43, 3); }

std::optional<KeplerEphemeris> lnav_ephemeris(std::span<const MessageBits, 3> subframes, int near_week) noexcept {
    KeplerEphemeris e;
    read_clock(subframes[0], e);
    read_orbit(subframes[1], subframes[2], e);
    const bool one_issue = e.issue == subframes[2].get(216, 8) && e.issue == (e.issue_clock & 0xFF);
    if (!one_issue) return std::nullopt;
    const double sent_s = subframes[0].get(24, 17) * 6.0;
    const GpsTime sent{nearest_week(static_cast<int>(subframes[0].get(48, 10)), 1024, near_week), sent_s};
    e.week = week_of(e.toe_s, sent);
    return e;
}

} // namespace locus::gnss
