#include "fusion/gnss/beidou_d2.h"

#include "fusion/gnss/beidou_d1.h"
#include "fusion/gnss/interface_pi.h"
#include "fusion/gnss/message_fields.h"

namespace locus::gnss {
namespace {

constexpr double seconds_per_page = 3, seconds_per_cycle = 30;

template <class Walk, ConstOrNot<KeplerEphemeris> E>
void walk_d2_clock(Walk& walk, E& e) {
    walk.number(e.health, {{0, 42, 1}});
    walk.number(e.issue_clock, {{0, 43, 5}});
    walk.number(e.accuracy, {{0, 48, 4}});
    walk.scaled(e.toc_s, {{0, 65, 17}}, 3);
    walk.scaled_signed(e.group_delay_s[0], {{0, 82, 10}}, 0, 1e-10);
    walk.scaled_signed(e.group_delay_s[1], {{0, 92, 10}}, 0, 1e-10);
    walk.scaled_signed(e.clock_s, {{2, 80, 24}}, -33);
    walk.scaled_signed(e.clock_drift, {{2, 104, 4}, {3, 42, 18}}, -50);
    walk.scaled_signed(e.clock_drift_rate_per_s, {{3, 60, 11}}, -66);
}

template <class Walk, ConstOrNot<KeplerEphemeris> E>
void walk_d2_orbit(Walk& walk, E& e) {
    walk.number(e.issue, {{3, 71, 5}});
    walk.scaled_signed(e.mean_motion_difference, {{3, 76, 16}}, -43, interface_pi);
    walk.scaled_signed(e.cuc, {{3, 92, 14}, {4, 42, 4}}, -31);
    walk.scaled_signed(e.mean_anomaly, {{4, 46, 32}}, -31, interface_pi);
    walk.scaled_signed(e.cus, {{4, 78, 18}}, -31);
    walk.scaled(e.eccentricity, {{4, 96, 10}, {5, 42, 22}}, -33);
    walk.scaled(e.root_a, {{5, 64, 32}}, -19);
    walk.scaled_signed(e.cic, {{5, 96, 10}, {6, 42, 8}}, -31);
    walk.scaled_signed(e.cis, {{6, 50, 18}}, -31);
    walk.scaled(e.toe_s, {{6, 68, 17}}, 3);
    walk.scaled_signed(e.inclination, {{6, 85, 21}, {7, 42, 11}}, -31, interface_pi);
    walk.scaled_signed(e.crc_m, {{7, 53, 18}}, -6);
    walk.scaled_signed(e.crs_m, {{7, 71, 18}}, -6);
    walk.scaled_signed(e.node_rate, {{7, 89, 19}, {8, 42, 5}}, -43, interface_pi);
    walk.scaled_signed(e.node, {{8, 47, 32}}, -31, interface_pi);
    walk.scaled_signed(e.perigee, {{8, 79, 27}, {9, 42, 5}}, -31, interface_pi);
    walk.scaled_signed(e.inclination_rate, {{9, 47, 14}}, -43, interface_pi);
}

double page_sent_s(const MessageBits& page) { return page.get(18, 20); }

} // namespace

unsigned d2_page_number(const MessageBits& subframe) noexcept {
    return d1_subframe_number(subframe) == 1 ? subframe.get(38, 4) : 0;
}

std::optional<KeplerEphemeris> d2_ephemeris(std::span<const MessageBits, 10> pages) noexcept {
    const double first_s = page_sent_s(pages[0]);
    for (std::size_t i = 1; i < pages.size(); ++i)
        if (page_sent_s(pages[i]) != first_s + static_cast<double>(i) * seconds_per_page) return std::nullopt;
    KeplerEphemeris e;
    e.constellation = constellation::beidou;
    const FieldReader reader{pages};
    walk_d2_clock(reader, e);
    walk_d2_orbit(reader, e);
    e.week = week_of(e.toe_s, {static_cast<int>(pages[0].get(52, 13)), first_s});
    return e;
}

std::optional<std::array<MessageBits, 10>> encode_d2(const KeplerEphemeris& e, const GpsTime& sent) noexcept {
    const GpsTime time = sent + -gps_minus_beidou_s;
    const double first_s = std::floor(time.second / seconds_per_cycle) * seconds_per_cycle;
    std::array<MessageBits, 10> pages;
    for (std::uint32_t i = 0; i < pages.size(); ++i) {
        const auto second = static_cast<std::uint32_t>(first_s + i * seconds_per_page);
        pages[i] = MessageBits{224};
        pages[i].set(0, 11, d1_preamble).set(15, 3, 1).set(18, 20, second).set(38, 4, i + 1);
    }
    FieldWriter writer{pages};
    walk_d2_clock(writer, e);
    walk_d2_orbit(writer, e);
    writer.number(time.week - beidou_week_ahead, {{0, 52, 13}});
    return writer.fits() ? std::optional{pages} : std::nullopt;
}

} // namespace locus::gnss
