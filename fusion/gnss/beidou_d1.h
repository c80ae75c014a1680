// D1, the navigation message of BeiDou's MEO and IGSO satellites on B1I, B2I and B3I (BDS-SIS-ICD B1I 3.0,
// section 5.2).
#pragma once

#include "fusion/gnss/ephemeris.h"
#include "fusion/gnss/message_bits.h"

#include <optional>
#include <span>

namespace locus::gnss {

inline constexpr std::uint32_t d1_preamble = 0b11100010010; ///< D2 has the same

/// Whether a satellite is geostationary: these broadcast D2, and their orbit is computed otherwise.
constexpr bool beidou_geostationary(unsigned satellite) {
    return satellite <= 5 || (satellite >= 59 && satellite <= 63);
}

/// The 224 information bits of a subframe from its ten words of 30 bits; empty when the preamble or a word's BCH(15,11)
/// code (5.1.3) is wrong.
std::optional<MessageBits> d1_subframe(std::span<const std::uint32_t> words) noexcept;

/// 1 to 5.
unsigned d1_subframe_number(const MessageBits& subframe) noexcept;

/// From subframes 1, 2 and 3; empty when they were not sent one after the other.
std::optional<KeplerEphemeris> d1_ephemeris(std::span<const MessageBits, 3> subframes) noexcept;

/// Subframes 1, 2 and 3 of the frame in which `sent` (GPS time) lies; empty when a value has no room in its field.
std::optional<std::array<MessageBits, 3>> encode_d1(const KeplerEphemeris& ephemeris, const GpsTime& sent) noexcept;

/// The words of a subframe, with their codes, as u-blox hands them over.
std::array<std::uint32_t, 10> d1_words(const MessageBits& subframe) noexcept;

} // namespace locus::gnss
