// I/NAV, the navigation message of Galileo E1-B and E5b-I (Galileo OS SIS ICD 2.1, section 4.3).
#pragma once

#include "fusion/gnss/ephemeris.h"
#include "fusion/gnss/message_bits.h"

#include <optional>
#include <span>

namespace locus::gnss {

/// The 128 bits of a word from an even and an odd page part, four words of 32 bits each as u-blox packs them; empty
/// when the parts do not belong together, the page is an alert, or the checksum (5.1.9.4: CRC-24Q) is wrong.
std::optional<MessageBits> inav_word(std::span<const std::uint32_t> words) noexcept;

/// 0 to 10, 16 to 22 and 63.
unsigned inav_word_type(const MessageBits& word) noexcept;

/// From words 1 to 5; empty when 1 to 4 are not of one issue. The group delays, health and time stand in word 5.
std::optional<KeplerEphemeris> inav_ephemeris(std::span<const MessageBits, 5> words, int near_gps_week) noexcept;

/// Words 1 to 5 as broadcast at `sent` (GPS time); empty when a value has no room in its field.
std::optional<std::array<MessageBits, 5>> encode_inav(const KeplerEphemeris& ephemeris, const GpsTime& sent) noexcept;

/// Both parts of the page of a word, with checksum, as u-blox hands them over.
std::array<std::uint32_t, 8> inav_words(const MessageBits& word) noexcept;

} // namespace locus::gnss
