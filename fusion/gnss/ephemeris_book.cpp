#include "fusion/gnss/ephemeris_book.h"

#include "fusion/gnss/lnav.h"
#include "fusion/gnss/lnav_ionosphere.h"

#include <algorithm>
#include <cmath>

namespace locus::gnss {
namespace {

/// Reference time of the orbit, in GPS time.
GpsTime reference(const KeplerEphemeris& e) {
    const GpsTime toe{e.week, e.toe_s};
    if (e.constellation == constellation::galileo) return {toe.week + galileo_week_ahead, toe.second};
    if (e.constellation == constellation::beidou)
        return GpsTime{toe.week + beidou_week_ahead, toe.second} + gps_minus_beidou_s;
    return toe;
}
GpsTime reference(const GlonassEphemeris& e) { return e.reference; }

GpsTime reference(const Ephemeris& ephemeris) {
    return std::visit([](const auto& e) { return reference(e); }, ephemeris);
}

double age_s(const Ephemeris& ephemeris, const GpsTime& time) { return std::abs(time - reference(ephemeris)); }

/// What speaks of other signals than that at L1 does not count: of QZSS the last bit, of Galileo those of E5b.
bool is_healthy(const KeplerEphemeris& e) {
    constexpr unsigned galileo_e1 = 0b001101, qzss_but_l6 = 0b111110, all = 0xFF;
    if (e.constellation == constellation::galileo) return (e.health & galileo_e1) == 0;
    return (e.health & (e.constellation == constellation::qzss ? qzss_but_l6 : all)) == 0;
}
bool is_healthy(const GlonassEphemeris& e) { return e.health == 0; }

} // namespace

void EphemerisBook::hear(const GnssNavigation& words, const GpsTime& now) noexcept {
    if (words.constellation == constellation::gps && words.signal == 0) hear_ionosphere(words);
    const auto ephemeris = collector_.add(words, now);
    const std::size_t place = satellite_place(words.constellation, words.satellite);
    if (!ephemeris || place == satellite_places::nowhere) return;
    auto& [newest, before] = said_[place];
    if (newest && reference(*newest) != reference(*ephemeris)) before = newest;
    newest = ephemeris;
}

/// GPS tells those of the whole world; QZSS has others for its region.
void EphemerisBook::hear_ionosphere(const GnssNavigation& words) noexcept {
    const auto heard = std::span{words.words}.first(std::min<std::size_t>(words.word_count, words.words.size()));
    const auto subframe = lnav_subframe(heard);
    if (!subframe) return;
    if (const auto coefficients = lnav_ionosphere(*subframe)) ionosphere_ = coefficients;
}

bool EphemerisBook::is_in_time(const Ephemeris& ephemeris, const GpsTime& time) const noexcept {
    const bool is_glonass = std::holds_alternative<GlonassEphemeris>(ephemeris);
    return age_s(ephemeris, time) <= (is_glonass ? max_glonass_age_s_ : max_age_s_);
}

// NOLINTBEGIN(bugprone-exception-escape): all alternatives are trivial, so the variant never loses its value
/// Of two that are in time the one whose reference is nearer; whether it is healthy the newest says.
EphemerisBook::Found EphemerisBook::find(std::uint8_t constellation, std::uint8_t satellite,
                                         const GpsTime& time) const noexcept {
    const std::size_t place = satellite_place(constellation, satellite);
    if (place == satellite_places::nowhere) return {nullptr, Exclusion::no_ephemeris};
    const auto& said = said_[place].newest;
    if (!said) return {nullptr, Exclusion::no_ephemeris};
    const Ephemeris& newest = *said;
    if (!std::visit([](const auto& e) { return is_healthy(e); }, newest)) return {nullptr, Exclusion::unhealthy};
    const auto& before = said_[place].before;
    const bool is_before = before && age_s(*before, time) < age_s(newest, time);
    const Ephemeris& nearest = is_before ? *before : newest;
    if (!is_in_time(nearest, time)) return {nullptr, Exclusion::ephemeris_too_old};
    return {&nearest, Exclusion::none};
}
// NOLINTEND(bugprone-exception-escape)

} // namespace locus::gnss
