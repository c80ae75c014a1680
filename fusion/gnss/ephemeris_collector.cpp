#include "fusion/gnss/ephemeris_collector.h"

#include "fusion/gnss/beidou_d1.h"
#include "fusion/gnss/beidou_d2.h"
#include "fusion/gnss/galileo_inav.h"
#include "fusion/gnss/glonass_strings.h"
#include "fusion/gnss/lnav.h"

#include <algorithm>

namespace locus::gnss {
namespace {

std::span<const std::uint32_t> words_of(const GnssNavigation& navigation) {
    return std::span{navigation.words}.first(std::min<std::size_t>(navigation.word_count, navigation.words.size()));
}

/// The place of a satellite numbered from 1, if it has one.
template <class Places>
auto place_of(Places& places, unsigned satellite) {
    return satellite >= 1 && satellite <= places.size() ? &places[satellite - 1] : nullptr;
}

// sigId of u-blox, where a satellite sends different messages on different signals.
bool is_lnav(std::uint8_t signal) { return signal == 0; }
bool is_inav(std::uint8_t signal) { return signal == 0 || signal == 1 || signal == 5 || signal == 6; }
bool is_d1(std::uint8_t signal) { return signal == 0 || signal == 2 || signal == 4; }
bool is_d2(std::uint8_t signal) { return signal == 1 || signal == 3 || signal == 10; }

/// 1 to 10: the geostationary ones are 1 to 5 and 59 to 63.
unsigned geostationary_number(unsigned satellite) { return satellite <= 5 ? satellite : satellite - 53; }

} // namespace

std::optional<Ephemeris> EphemerisCollector::add(const GnssNavigation& from, const GpsTime& now) noexcept {
    const auto words = words_of(from);
    switch (from.constellation) {
    case constellation::gps:
        if (auto* parts = place_of(gps_, from.satellite); parts && is_lnav(from.signal))
            return lnav(*parts, from, words, now.week);
        break;
    case constellation::qzss:
        if (auto* parts = place_of(qzss_, from.satellite); parts && is_lnav(from.signal))
            return lnav(*parts, from, words, now.week);
        break;
    case constellation::galileo:
        if (auto* parts = place_of(galileo_, from.satellite); parts && is_inav(from.signal))
            return inav(*parts, words, now.week);
        break;
    case constellation::beidou:
        if (beidou_geostationary(from.satellite)) {
            if (auto* parts = place_of(geostationary_, geostationary_number(from.satellite));
                parts && is_d2(from.signal))
                return d2(*parts, from, words);
        } else if (auto* parts = place_of(beidou_, from.satellite); parts && is_d1(from.signal))
            return d1(*parts, from, words);
        break;
    case constellation::glonass:
        if (auto* parts = place_of(glonass_, from.satellite)) return glonass(*parts, from, words, now);
        break;
    default:
        break;
    }
    return std::nullopt;
}

std::optional<Ephemeris> EphemerisCollector::lnav(Parts<3>& parts, const GnssNavigation& from, Words words,
                                                  int week) noexcept {
    const auto subframe = lnav_subframe(words);
    if (!subframe || !parts.put(lnav_subframe_number(*subframe), *subframe)) return std::nullopt;
    auto ephemeris = lnav_ephemeris(parts.parts, week);
    if (!ephemeris) return std::nullopt;
    ephemeris->constellation = from.constellation;
    ephemeris->satellite = from.satellite;
    parts.have = 0;
    return ephemeris;
}

std::optional<Ephemeris> EphemerisCollector::inav(Parts<5>& parts, Words words, int week) noexcept {
    const auto word = inav_word(words);
    if (!word || !parts.put(inav_word_type(*word), *word)) return std::nullopt;
    const auto ephemeris = inav_ephemeris(parts.parts, week);
    if (!ephemeris) return std::nullopt;
    parts.have = 0;
    return ephemeris;
}

std::optional<Ephemeris> EphemerisCollector::d1(Parts<3>& parts, const GnssNavigation& from, Words words) noexcept {
    const auto subframe = d1_subframe(words);
    if (!subframe || !parts.put(d1_subframe_number(*subframe), *subframe)) return std::nullopt;
    auto ephemeris = d1_ephemeris(parts.parts);
    if (!ephemeris) return std::nullopt;
    ephemeris->satellite = from.satellite;
    parts.have = 0;
    return ephemeris;
}

std::optional<Ephemeris> EphemerisCollector::d2(Parts<10>& parts, const GnssNavigation& from, Words words) noexcept {
    const auto subframe = d1_subframe(words);
    if (!subframe || !parts.put(d2_page_number(*subframe), *subframe)) return std::nullopt;
    auto ephemeris = d2_ephemeris(parts.parts);
    if (!ephemeris) return std::nullopt;
    ephemeris->satellite = from.satellite;
    parts.have = 0;
    return ephemeris;
}

/// A fourth word holds the numbers of superframe and frame: strings of different frames are not mixed.
std::optional<Ephemeris> EphemerisCollector::glonass(GlonassParts& parts, const GnssNavigation& from, Words words,
                                                     const GpsTime& now) const noexcept {
    const auto string = glonass_string(words);
    if (!string) return std::nullopt;
    const std::uint32_t frame = words.size() > 3 ? words[3] >> 16 : 0;
    if (std::exchange(parts.frame, frame) != frame) parts.have = 0;
    if (!parts.put(glonass_string_number(*string), *string)) return std::nullopt;
    auto ephemeris = glonass_ephemeris(parts.parts, now, leap_s_);
    if (!ephemeris || ephemeris->satellite != from.satellite) return std::nullopt;
    ephemeris->frequency = static_cast<std::int8_t>(from.glonass_slot - 7);
    parts.have = 0;
    return ephemeris;
}

} // namespace locus::gnss
