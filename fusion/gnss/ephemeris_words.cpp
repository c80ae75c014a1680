#include "fusion/gnss/ephemeris_words.h"

#include "fusion/gnss/beidou_d1.h"
#include "fusion/gnss/beidou_d2.h"
#include "fusion/gnss/galileo_inav.h"
#include "fusion/gnss/glonass_strings.h"
#include "fusion/gnss/lnav.h"
#include "fusion/gnss/lnav_ionosphere.h"

#include <algorithm>
#include <cmath>

namespace locus::gnss {
namespace {

/// Signals of u-blox on which a message is sent; the others send theirs on signal 0.
constexpr std::uint8_t galileo_e1b = 1, beidou_b1i_d2 = 1;

template <class Words>
GnssNavigation with_words(GnssNavigation head, const Words& words) {
    head.word_count = static_cast<std::uint8_t>(words.size());
    std::ranges::copy(words, head.words.begin());
    return head;
}

template <class Parts, class ToWords>
std::vector<GnssNavigation> listed(const std::optional<Parts>& parts, const GnssNavigation& head,
                                   const ToWords& to_words) {
    std::vector<GnssNavigation> all;
    if (!parts) return all;
    for (const MessageBits& part : *parts) all.push_back(with_words(head, to_words(part)));
    return all;
}

std::vector<GnssNavigation> words_of(const KeplerEphemeris& e, const GpsTime& sent, int /*leap_s*/) {
    GnssNavigation head;
    head.constellation = e.constellation;
    head.satellite = e.satellite;
    switch (e.constellation) {
    case constellation::gps:
    case constellation::qzss:
        return listed(encode_lnav(e, sent), head, lnav_words);
    case constellation::galileo:
        head.signal = galileo_e1b;
        return listed(encode_inav(e, sent), head, inav_words);
    case constellation::beidou:
        if (beidou_geostationary(e.satellite)) {
            head.signal = beidou_b1i_d2;
            return listed(encode_d2(e, sent), head, d1_words);
        }
        return listed(encode_d1(e, sent), head, d1_words);
    default:
        return {};
    }
}

std::vector<GnssNavigation> words_of(const GlonassEphemeris& e, const GpsTime& sent, int leap_s) {
    GnssNavigation head;
    head.constellation = constellation::glonass;
    head.satellite = e.satellite;
    head.glonass_slot = static_cast<std::uint8_t>(e.frequency + 7);
    constexpr double frame_s = 30;
    const auto frame = static_cast<std::uint32_t>(sent.second / frame_s);
    return listed(encode_glonass(e, leap_s), head,
                  [frame](const MessageBits& string) { return glonass_words(string, frame); });
}

} // namespace

std::vector<GnssNavigation> encode(const Ephemeris& ephemeris, const GpsTime& sent, int leap_s) {
    return std::visit([&](const auto& e) { return words_of(e, sent, leap_s); }, ephemeris);
}

std::optional<GnssNavigation> encode(const Klobuchar& coefficients, std::uint8_t gps_satellite, const GpsTime& sent) {
    const auto page = encode_lnav_ionosphere(coefficients, sent);
    if (!page) return std::nullopt;
    GnssNavigation head;
    head.constellation = constellation::gps;
    head.satellite = gps_satellite;
    return with_words(head, lnav_words(*page));
}

} // namespace locus::gnss
