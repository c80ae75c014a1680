// D2, the navigation message of BeiDou's geostationary satellites on B1I, B2I and B3I (BDS-SIS-ICD B1I 3.0, section
// 5.3): the ephemeris stands in the ten pages of subframe 1, whose frame and codes are those of D1.
#pragma once

#include "fusion/gnss/ephemeris.h"
#include "fusion/gnss/message_bits.h"

#include <array>
#include <optional>
#include <span>

namespace locus::gnss {

/// 1 to 10 of a subframe 1 that d1_subframe() read; 0 of another subframe.
unsigned d2_page_number(const MessageBits& subframe) noexcept;

/// From pages 1 to 10; empty when they were not sent one after the other.
std::optional<KeplerEphemeris> d2_ephemeris(std::span<const MessageBits, 10> pages) noexcept;

/// Pages 1 to 10, of the 30 seconds in which `sent` (GPS time) lies; empty when a value has no room in its field. Their
/// words are made by d1_words().
std::optional<std::array<MessageBits, 10>> encode_d2(const KeplerEphemeris& ephemeris, const GpsTime& sent) noexcept;

} // namespace locus::gnss
